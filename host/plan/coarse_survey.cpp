#include "plan/coarse_survey.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "base/task_pool.hpp"
#include "base/threads.hpp"
#include "mesh/instance.hpp"

namespace nook {
namespace {

constexpr std::size_t grain = 1 << 16;   // triangles that a thread takes at a time
constexpr std::size_t most_coarse = 16;  // that are kept
constexpr std::size_t most_small = 64;   // samples of small triangles

using Corners = std::array<vec3, 3>;

Corners corners_of(const TriangleMesh& mesh, std::size_t i) {
  const auto& t = mesh.triangles[i];
  return {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
}

CoarseTriangle triangle_of(const TriangleMesh& mesh, std::size_t i) {
  const Corners p = corners_of(mesh, i);
  return {i, p[0], p[1], p[2]};
}

// What no normal is needed for: its resolution is at most `bound`.
struct Extents {
  vec3 lo, hi;
  float extent, bound;

  explicit Extents(const Corners& p)
      : lo(glm::min(p[0], glm::min(p[1], p[2]))), hi(glm::max(p[0], glm::max(p[1], p[2]))) {
    const vec3 sides = hi - lo, any = glm::max(sides, 0.125f * glm::max(glm::abs(lo), glm::abs(hi)));
    extent = std::max({sides.x, sides.y, sides.z});
    bound = 0x1.41p-17f * (any.x + any.y + any.z) + 0x1.01p-31f * extent;
  }
  bool far_from(const std::optional<dvec3>& p) const {
    if (!p) return true;
    const dvec3 away = glm::max(glm::max(dvec3(lo) - *p, *p - dvec3(hi)), dvec3(0));
    return std::max({away.x, away.y, away.z}) > double(bound);
  }
  // Surely wider than its resolution. n: as long as twice its area.
  bool wide(const dvec3& n) const {
    const double least = std::max(double(bound), edge_resolution * double(extent));
    return glm::dot(n, n) > 3 * double(extent) * double(extent) * least * least;
  }
};

// visit(piece, number) for all triangles of a mesh without instances, and join(piece) for each piece.
template <class Piece, class Visit, class Join>
void for_pieces(const TriangleMesh& mesh, const Visit& visit, const Join& join) {
  TaskPool pool(threads_to_use());
  std::mutex mutex;
  pool.for_ranges(mesh.triangles.size(), grain, [&](std::size_t begin, std::size_t end) {
    Piece piece;
    for (std::size_t i = begin; i < end; ++i) visit(piece, i);
    const std::scoped_lock lock(mutex);
    join(piece);
  });
}

}  // namespace

void CoarseSurvey::look_at(std::uint64_t number, const std::array<vec3, 3>& p,
                           const std::optional<dvec3>& eye) {
  const Extents extents(p);
  const dvec3 n = glm::cross(dvec3(p[1]) - dvec3(p[0]), dvec3(p[2]) - dvec3(p[0]));
  const bool usual = coarsest.size() == most_coarse && double(extents.bound) < coarsest.back().resolution &&
                     double(extents.extent) < largest->extent && extents.wide(n) && extents.far_from(eye);
  if (!usual) return look_closer({number, p[0], p[1], p[2]}, eye);
  ++triangles;
  least_extent = std::min(least_extent, double(extents.extent));
}

void CoarseSurvey::look_closer(const CoarseTriangle& t, const std::optional<dvec3>& eye) {
  if (t.normal == dvec3(0)) return;
  ++triangles;
  least_extent = std::min(least_extent, t.extent);
  take_larger(t);
  keep(t);
  if (t.width < t.width_resolution()) {
    ++narrow;
    narrowest.add(t, t.width_resolution(), t.width);
  }
  if (eye && std::abs(glm::dot(t.normal, *eye - t.corner[0])) < t.resolution) {
    const double distance = t.distance(*eye);
    if (distance > 0) from_eye.add(t, t.resolution, distance);
  }
}

void CoarseSurvey::keep(const CoarseTriangle& t) {
  if (coarsest.size() == most_coarse && !t.coarser_than(coarsest.back())) return;
  const auto place = std::find_if(coarsest.begin(), coarsest.end(),
                                  [&](const CoarseTriangle& other) { return t.coarser_than(other); });
  coarsest.insert(place, t);
  if (coarsest.size() > most_coarse) coarsest.pop_back();
}

void CoarseSurvey::take_larger(const CoarseTriangle& t) {
  if (!largest || t.extent > largest->extent || (t.extent == largest->extent && t.number < largest->number))
    largest = t;
}

void CoarseSurvey::add(const CoarseSurvey& other) {
  triangles += other.triangles, narrow += other.narrow;
  least_extent = std::min(least_extent, other.least_extent);
  narrowest.add(other.narrowest), from_eye.add(other.from_eye);
  if (other.largest) take_larger(*other.largest);
  for (const CoarseTriangle& t : other.coarsest) keep(t);
}

CoarseSurvey survey_of(const TriangleMesh& mesh, const std::optional<dvec3>& eye) {
  CoarseSurvey whole;
  if (mesh.instances.empty()) {
    for_pieces<CoarseSurvey>(
        mesh, [&](CoarseSurvey& piece, std::size_t i) { piece.look_at(i, corners_of(mesh, i), eye); },
        [&](const CoarseSurvey& piece) { whole.add(piece); });
    return whole;
  }
  std::vector<CoarseSurvey> of_model(mesh.models.size());
  for (std::size_t p = 0; p < mesh.models.size(); ++p)
    for (std::uint32_t i = 0; i < mesh.models[p].triangles; ++i) {
      const std::size_t number = mesh.models[p].first_triangle + i;
      of_model[p].look_at(number, corners_of(mesh, number), {});
    }
  for (const TriangleMesh::Instance& instance : mesh.instances)
    for (const CoarseTriangle& own : of_model[instance.model].coarsest) {
      Corners p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = placed_position(instance.place, vec3(own.corner[k]));
      const std::uint64_t number =
          instance.place.first_triangle + own.number - mesh.models[instance.model].first_triangle;
      whole.look_at(number, p, eye);
    }
  whole.narrow = 0;
  return whole;
}

CoarsestFor coarsest_for_small(const TriangleMesh& mesh, const CoarseSurvey& survey) {
  if (survey.coarsest.empty() || survey.least_extent >= survey.coarsest.front().resolution) return {};
  std::vector<std::uint32_t> small;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (const CoarseTriangle t = triangle_of(mesh, i);
        t.normal != dvec3(0) && t.extent < 0.01 * survey.largest->extent)
      small.push_back(std::uint32_t(i));
  const std::size_t count = std::min(small.size(), most_small);
  std::vector<CoarseTriangle> samples;
  for (std::size_t i = 0; i < count; ++i)
    samples.push_back(triangle_of(mesh, small[i * small.size() / count]));

  using Found = std::vector<CoarsestFor>;
  Found whole(count);
  struct Piece {
    Found of;
  };
  const auto visit = [&](Piece& piece, std::size_t number) {
    piece.of.resize(count);
    const CoarseTriangle t = triangle_of(mesh, number);
    for (std::size_t i = 0; i < count; ++i) {
      const CoarseTriangle& s = samples[i];
      if (s.extent >= t.resolution) continue;
      const dvec3 middle = (s.corner[0] + s.corner[1] + s.corner[2]) / 3.0;
      if (std::abs(glm::dot(t.normal, middle - t.corner[0])) < t.resolution &&
          t.distance(middle) < t.resolution)
        piece.of[i].add(t, t.resolution, s.extent);
    }
  };
  for_pieces<Piece>(mesh, visit, [&](const Piece& piece) {
    for (std::size_t i = 0; i < piece.of.size(); ++i) whole[i].add(piece.of[i]);
  });
  CoarsestFor largest;
  std::size_t near = 0;
  for (const CoarsestFor& of_sample : whole) {
    if (!of_sample.triangle) continue;
    if (near++ == 0 || of_sample.distance > largest.distance) largest = of_sample;
  }
  return 4 * near > count ? largest : CoarsestFor();
}

}  // namespace nook
