#include "mesh/triangulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <type_traits>

#include "base/error.hpp"
#include "base/task_pool.hpp"
#include "base/threads.hpp"
#include "mesh/block_triangles.hpp"
#include "mesh/corner_order.hpp"

namespace nook {
namespace {

constexpr std::size_t grain = 1 << 16;  // elements that a thread takes at a time

// Unit normals; those that cannot be normalised become 0, which corners do not refer to. Returns how many had
// another length.
std::uint64_t normalise(std::vector<vec3>& normals, TaskPool& pool) {
  std::atomic<std::uint64_t> all = 0;
  pool.for_ranges(normals.size(), grain, [&](std::size_t begin, std::size_t end) {
    std::uint64_t changed = 0;
    for (std::size_t i = begin; i < end; ++i) {
      vec3& n = normals[i];
      const double length = glm::length(dvec3(n));
      const bool usable = std::isfinite(length) && length > 1e-30;
      changed += usable && std::abs(length - 1) > 1e-3;
      n = usable ? vec3(dvec3(n) / length) : vec3(0);
    }
    all += changed;
  });
  return all;
}

// Calls visit(array) for each of the arrays that have an entry a triangle.
template <class Visit>
void for_each_array(Visit visit) {
  visit(&TriangleMesh::triangles);
  visit(&TriangleMesh::triangle_normals);
  visit(&TriangleMesh::triangle_uvs);
  visit(&TriangleMesh::triangle_material);
  visit(&TriangleMesh::triangle_group);
}

// Drops the triangles that have a position which is not finite, and counts them; then makes part.bounds, and
// turns the triangles.
void finish(TriangleMesh& part, const std::vector<vec3>& positions) {
  const std::size_t count = part.triangles.size();
  std::vector<std::uint32_t> kept;
  kept.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [a, b, c] = part.triangles[i];
    if (!finite(positions[a]) || !finite(positions[b]) || !finite(positions[c])) continue;
    kept.push_back(std::uint32_t(i));
    for (const std::uint32_t index : {a, b, c}) part.bounds.add(positions[index]);
  }
  part.report.triangles_read = count;
  part.report.non_finite_dropped = count - kept.size();
  for_each_array([&](auto array) {
    auto& values = part.*array;
    if (values.empty() || kept.size() == count) return;
    for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
    values.resize(kept.size());
  });
  for (const auto& corners : part.triangle_normals)
    for (const std::uint32_t n : corners) part.report.normals_replaced += n == TriangleMesh::no_normal;
  end_with_longest_edges(part, positions);
}

// The parts' triangles, what each of them has, bounds and counts, behind one another in `mesh`. The parts are
// left empty.
void join(TriangleMesh& mesh, std::vector<TriangleMesh>& parts) {
  for_each_array([&](auto array) {
    std::size_t total = 0;
    for (const TriangleMesh& part : parts) total += (part.*array).size();
    auto& whole = mesh.*array;
    whole.reserve(total);
    for (TriangleMesh& part : parts) {
      whole.insert(whole.end(), (part.*array).begin(), (part.*array).end());
      std::remove_reference_t<decltype(whole)>().swap(part.*array);
    }
  });
  for (const TriangleMesh& part : parts) {
    mesh.bounds.add(part.bounds);
    mesh.report.triangles_read += part.report.triangles_read;
    mesh.report.non_finite_dropped += part.report.non_finite_dropped;
    mesh.report.normals_replaced += part.report.normals_replaced;
  }
}

// Leaves out what no triangle has.
void drop_unused(TriangleMesh& mesh) {
  if (mesh.report.normals_replaced == 3 * mesh.triangles.size()) {
    mesh.normals.clear();
    mesh.triangle_normals.clear();
    mesh.report.normals_replaced = 0;
  }
  const auto no_uv = [](const auto& corners) {
    return std::all_of(corners.begin(), corners.end(),
                       [](std::uint32_t i) { return i == TriangleMesh::no_uv; });
  };
  if (std::all_of(mesh.triangle_uvs.begin(), mesh.triangle_uvs.end(), no_uv)) mesh.triangle_uvs.clear();
}

// Triangles whose corners are different places in the file and the same float.
std::uint64_t collapsed(const TriangleMesh& part, const std::vector<vec3>& positions,
                        const LargeVector<dvec3>& in_file) {
  std::uint64_t count = 0;
  for (const auto& corners : part.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = corners[k], b = corners[(k + 1) % 3];
      if (positions[a] != positions[b] || in_file[a] == in_file[b]) continue;
      ++count;
      break;
    }
  return count;
}

void warn_of_crossings(TriangleMesh& mesh, const PolygonMesh& polygons,
                       const std::vector<CrossedFaces>& crossed) {
  CrossedFaces all;
  for (const CrossedFaces& c : crossed) {
    if (all.faces == 0) all.first_place = c.first_place;
    all.faces += c.faces;
  }
  if (all.faces == 0) return;
  const std::string others = all.faces > 1 ? fmt::format(" (and {} more)", all.faces - 1) : "";
  mesh.report.warnings.push_back(fmt::format("{}:{}{}: the face's outline crosses itself{}", polygons.name,
                                             polygons.place, all.first_place, others));
}

// Of the positions that floats can hold.
Frame frame_of(const LargeVector<dvec3>& positions, TaskPool& pool) {
  std::mutex mutex;
  dvec3 lo(HUGE_VAL), hi(-HUGE_VAL);
  pool.for_ranges(positions.size(), grain, [&](std::size_t begin, std::size_t end) {
    dvec3 least(HUGE_VAL), most(-HUGE_VAL);
    for (std::size_t i = begin; i < end; ++i) {
      if (!finite(vec3(positions[i]))) continue;
      least = glm::min(least, positions[i]);
      most = glm::max(most, positions[i]);
    }
    const std::scoped_lock lock(mutex);
    lo = glm::min(lo, least);
    hi = glm::max(hi, most);
  });
  return frame_for(lo, hi);
}

}  // namespace

TriangleMesh triangulated(PolygonMesh&& polygons, const MeshAttributes& want) {
  std::vector<FaceBlock>& blocks = polygons.blocks;
  const std::size_t tasks = std::max(blocks.size(), polygons.positions.size() / grain);
  TaskPool pool(unsigned(std::min<std::size_t>(threads_to_use(), std::max<std::size_t>(tasks, 1))));
  TriangleMesh mesh;
  mesh.frame = frame_of(polygons.positions, pool);
  mesh.positions.resize(polygons.positions.size());
  pool.for_ranges(mesh.positions.size(), grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const dvec3& p = polygons.positions[i];
      mesh.positions[i] = finite(vec3(p)) ? vec3(mesh.frame.from_file(p)) : vec3(p);
    }
  });
  if (want.normals) mesh.normals = std::move(polygons.normals);
  if (want.uvs) mesh.uvs = std::move(polygons.uvs);
  if (want.materials) mesh.materials = std::move(polygons.materials);
  if (want.groups) {
    mesh.groups = std::move(polygons.groups);
    mesh.group_names = std::move(polygons.group_names);
  }
  mesh.report.warnings = std::move(polygons.warnings);
  mesh.report.normals_normalised = normalise(mesh.normals, pool);

  std::vector<TriangleMesh> parts(blocks.size());
  std::vector<CrossedFaces> crossed(blocks.size());
  std::atomic<std::uint64_t> lost = 0;
  pool.for_ranges(blocks.size(), 1, [&](std::size_t i, std::size_t) {
    parts[i] = BlockTriangles(polygons, mesh, want).of(blocks[i], crossed[i]);
    blocks[i] = {};
    finish(parts[i], mesh.positions);
    lost += collapsed(parts[i], mesh.positions, polygons.positions);
  });
  LargeVector<dvec3>().swap(polygons.positions);
  join(mesh, parts);

  warn_of_crossings(mesh, polygons, crossed);
  if (lost > 0)
    mesh.report.warnings.push_back(fmt::format(
        "{}: {} triangles are lost: their corners are nearer to each other than floats tell apart "
        "in a scene that reaches {:g}",
        polygons.name, lost.load(), mesh.frame.to_file(double(mesh.bounds.bounding_radius()))));
  drop_unused(mesh);
  if (mesh.triangles.empty())
    throw Error(ErrorKind::scene, Place{polygons.name},
                mesh.report.non_finite_dropped
                    ? fmt::format("no triangle is left ({} have NaN or infinite vertices)",
                                  mesh.report.non_finite_dropped)
                    : "the mesh has no triangles");
  return mesh;
}

}  // namespace nook
