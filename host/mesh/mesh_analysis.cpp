#include "mesh/mesh_analysis.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <memory>
#include <unordered_set>

#include "mesh/opacity_maps.hpp"

namespace nook {
namespace {

std::uint64_t position_key(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& triangle) {
  std::array<std::uint64_t, 3> corners{};
  for (std::size_t k = 0; k < 3; ++k) {
    const vec3 p = mesh.positions[triangle[k]] + 0.0f;  // -0 and 0 are the same place
    corners[k] = XXH3_64bits(&p, sizeof p);
  }
  std::sort(corners.begin(), corners.end());
  return XXH3_64bits(corners.data(), sizeof corners);
}

template <class T>
void update(XXH3_state_t* state, const std::vector<T>& values) {
  const std::uint64_t count = values.size();
  XXH3_128bits_update(state, &count, sizeof count);
  XXH3_128bits_update(state, values.data(), values.size() * sizeof(T));
}

}  // namespace

MeshAnalysis analyse(const TriangleMesh& mesh) {
  MeshAnalysis analysis;
  std::unordered_set<std::uint64_t> seen;
  seen.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    const dvec3 p0(mesh.positions[triangle[0]]), p1(mesh.positions[triangle[1]]),
        p2(mesh.positions[triangle[2]]);
    analysis.zero_area += glm::cross(p1 - p0, p2 - p0) == dvec3(0);
    analysis.duplicates += !seen.insert(position_key(mesh, triangle)).second;
  }
  return analysis;
}

std::string mesh_hash(const TriangleMesh& mesh) {
  const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), XXH3_freeState);
  XXH3_128bits_reset(state.get());
  update(state.get(), mesh.positions);
  if (mesh.frame != Frame()) {
    XXH3_128bits_update(state.get(), &mesh.frame.center, sizeof mesh.frame.center);
    XXH3_128bits_update(state.get(), &mesh.frame.exponent, sizeof mesh.frame.exponent);
  }
  update(state.get(), mesh.normals);
  update(state.get(), mesh.triangles);
  update(state.get(), mesh.triangle_normals);
  update(state.get(), mesh.triangle_material);
  update(state.get(), mesh.triangle_group);
  for (const std::string& group : mesh.groups)
    XXH3_128bits_update(state.get(), group.data(), group.size() + 1);
  for (const Material& material : mesh.materials) {
    XXH3_128bits_update(state.get(), material.name.data(), material.name.size() + 1);
    XXH3_128bits_update(state.get(), &material.phong_exponent, sizeof material.phong_exponent);
    // Not the map's path: a mesh may be moved. Its options only if it has some.
    const std::optional<std::uint32_t> index = index_of_map(mesh, material);
    const std::int64_t map = index ? std::int64_t(*index) : -1;
    XXH3_128bits_update(state.get(), &map, sizeof map);
    const MapLookup& lookup = material.map;
    if (map >= 0 && (lookup.scale != vec2(1) || lookup.offset != vec2(0) || lookup.clamp)) {
      const float options[5] = {lookup.scale.x, lookup.scale.y, lookup.offset.x, lookup.offset.y,
                                lookup.clamp ? 1.0f : 0.0f};
      XXH3_128bits_update(state.get(), options, sizeof options);
    }
  }
  for (const TriangleMesh::Instance& instance : mesh.instances)
    XXH3_128bits_update(state.get(), &instance, sizeof instance);
  if (!mesh.opacity_maps.empty()) {
    update(state.get(), mesh.uvs);
    update(state.get(), mesh.triangle_uvs);
    for (const OpacityMap& map : mesh.opacity_maps) {
      const std::uint32_t size[2] = {map.width, map.height};
      XXH3_128bits_update(state.get(), size, sizeof size);
      update(state.get(), map.opacity);
    }
  }
  const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace nook
