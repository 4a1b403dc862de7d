#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "math/bounds.hpp"
#include "math/types.hpp"

namespace nook {

/// A surface's material, from the MTL file. Only what an effect can read is kept.
struct Material {
  std::string name;
  float phong_exponent = -1.0f;  ///< Ns; negative: the material has no lobe (no Ns, or Ks 0 0 0)
  std::string opacity_map;       ///< map_d, path as resolved; empty: opaque
};

/// An opacity map: a byte a texel, row 0 at the top (v = 1).
struct OpacityMap {
  std::string file;
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> opacity;
};

/// Indexed triangles, shared by the path tracer and SSAO.
///
/// Invariants after loading: every index is in range; positions of every triangle are finite; `normals` are
/// unit length. A corner without a usable normal has index `no_normal`: it shades with the geometric normal.
/// `triangle_normals`, `triangle_uvs` and `triangle_material` are either empty (the mesh has none) or as long
/// as `triangles`.
struct TriangleMesh {
  static constexpr std::uint32_t no_normal = 0xffffffffu;

  std::vector<vec3> positions;  ///< world units
  std::vector<vec3> normals;    ///< unit length
  std::vector<vec2> uvs;
  std::vector<std::array<std::uint32_t, 3>> triangles;         ///< indices into positions, counter-clockwise
  std::vector<std::array<std::uint32_t, 3>> triangle_normals;  ///< indices into normals, or no_normal
  std::vector<std::array<std::uint32_t, 3>> triangle_uvs;      ///< indices into uvs, or 0xffffffff
  std::vector<std::uint32_t> triangle_material;                ///< index into materials
  std::vector<std::uint32_t> triangle_group;                   ///< index into groups
  std::vector<Material> materials;
  std::vector<std::string> groups;
  std::vector<OpacityMap> opacity_maps;  ///< each once, if the scene asks for cut-outs
  Bounds3 bounds;                        ///< of the positions that triangles use
  Bounds3 subject;  ///< the bounds without the ground that a scene added; empty if there is none
  /// What automatic distances and cameras refer to.
  const Bounds3& subject_bounds() const { return subject.empty() ? bounds : subject; }

  /// What the loader found and did; `nook info` prints it.
  struct Report {
    std::uint64_t triangles_read = 0;
    std::uint64_t non_finite_dropped = 0;  ///< triangles with a NaN or infinite vertex
    std::uint64_t normals_replaced = 0;    ///< corners whose normal was missing, zero or not finite
    std::uint64_t normals_normalised = 0;  ///< normals whose length was not 1 (within 1e-3)
  } report;

  bool empty() const { return triangles.empty(); }
  bool has_normals() const { return !triangle_normals.empty(); }
};

}  // namespace nook
