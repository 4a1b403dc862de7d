#include "part.hpp"

#include <algorithm>
#include <cmath>

namespace nook::meshgen {

void Part::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  if (glm::distance(positions[a], positions[c]) <= glm::distance(positions[b], positions[d])) {
    triangle(a, b, c);
    triangle(a, c, d);
  } else {
    triangle(a, b, d);
    triangle(b, c, d);
  }
}

namespace {

double corner_angle(const Part& part, const std::array<std::uint32_t, 3>& t, int corner) {
  const dvec3 p = part.positions[t[corner]];
  const dvec3 a = part.positions[t[(corner + 1) % 3]] - p, b = part.positions[t[(corner + 2) % 3]] - p;
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

Part shaded(Part part, double crease) {
  const double cos_crease = std::cos(glm::radians(crease));
  const std::size_t count = part.triangles.size();
  std::vector<dvec3> face(count);
  std::vector<std::uint32_t> first(part.positions.size() + 1, 0);
  for (std::size_t t = 0; t < count; ++t) {
    const auto& i = part.triangles[t];
    const dvec3 n =
        glm::cross(part.positions[i[1]] - part.positions[i[0]], part.positions[i[2]] - part.positions[i[0]]);
    const double length = glm::length(n);
    face[t] = length > 0 ? n / length : dvec3(0);
    for (const std::uint32_t v : i) ++first[v + 1];
  }
  for (std::size_t v = 1; v < first.size(); ++v) first[v] += first[v - 1];
  std::vector<std::uint32_t> around(3 * count), next(first.begin(), first.end() - 1);
  for (std::size_t c = 0; c < 3 * count; ++c) around[next[part.triangles[c / 3][c % 3]]++] = std::uint32_t(c);

  part.normals.clear();
  part.triangle_normals.assign(count, {});
  std::vector<std::pair<dvec3, std::uint32_t>> known;  // the normals made at this vertex
  for (std::size_t v = 0; v + 1 < first.size(); ++v) {
    known.clear();
    for (std::uint32_t k = first[v]; k < first[v + 1]; ++k) {
      const std::uint32_t corner = around[k];
      dvec3 sum(0);
      for (std::uint32_t j = first[v]; j < first[v + 1]; ++j) {
        const std::uint32_t other = around[j];
        if (other == corner || glm::dot(face[other / 3], face[corner / 3]) >= cos_crease)
          sum += face[other / 3] * corner_angle(part, part.triangles[other / 3], int(other % 3));
      }
      const double length = glm::length(sum);
      const dvec3 n = length > 0 ? sum / length : dvec3(0, 1, 0);
      const auto same = std::find_if(known.begin(), known.end(),
                                     [&](const auto& e) { return glm::distance(e.first, n) < 1e-9; });
      std::uint32_t index;
      if (same != known.end()) {
        index = same->second;
      } else {
        index = std::uint32_t(part.normals.size());
        part.normals.push_back(n);
        known.emplace_back(n, index);
      }
      part.triangle_normals[corner / 3][corner % 3] = index;
    }
  }
  return part;
}

Part transformed(const Part& part, const dmat4& m) {
  Part out = part;
  const glm::dmat3 linear(m);
  const glm::dmat3 cofactor = glm::transpose(glm::inverse(linear));
  for (dvec3& p : out.positions) p = dvec3(m * glm::dvec4(p, 1));
  for (dvec3& n : out.normals) n = glm::normalize(cofactor * n);
  if (glm::determinant(linear) < 0) {
    for (auto& t : out.triangles) std::swap(t[1], t[2]);
    for (auto& t : out.triangle_normals) std::swap(t[1], t[2]);
  }
  return out;
}

void append(Part& to, const Part& from) {
  const std::uint32_t positions = std::uint32_t(to.positions.size());
  const std::uint32_t normals = std::uint32_t(to.normals.size());
  to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
  to.normals.insert(to.normals.end(), from.normals.begin(), from.normals.end());
  for (auto t : from.triangles)
    to.triangles.push_back({t[0] + positions, t[1] + positions, t[2] + positions});
  for (auto t : from.triangle_normals)
    to.triangle_normals.push_back({t[0] + normals, t[1] + normals, t[2] + normals});
}

void Model::add(const std::string& group, const std::string& material, const Part& part, const dmat4& m) {
  auto it = std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) { return g.name == group; });
  if (it == groups_.end()) it = groups_.insert(it, Group{group, material, {}});
  append(it->part, transformed(part.triangle_normals.empty() ? shaded(part) : part, m));
}

void Model::transform(const dmat4& m) {
  for (Group& g : groups_) g.part = transformed(g.part, m);
}

std::size_t Model::triangle_count() const {
  std::size_t count = 0;
  for (const Group& g : groups_) count += g.part.triangles.size();
  return count;
}

}  // namespace nook::meshgen
