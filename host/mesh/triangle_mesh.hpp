#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kernels/shared/instance.h"
#include "math/axis.hpp"
#include "math/bounds.hpp"
#include "math/frame.hpp"
#include "math/types.hpp"

namespace nook {

/// How a material looks up its opacity map (the options of map_d): texel = map(uv * scale + offset) of a
/// channel, opacity = base + gain * texel, limited to 0 to 1.
struct MapLookup {
  vec2 scale{1, 1}, offset{0, 0};  ///< -s, -o
  float base = 0, gain = 1;        ///< -mm
  char channel = 0;    ///< -imfchan: r, g, b, m (alpha), l (luminance); 0: alpha, or luminance if none
  bool clamp = false;  ///< -clamp: opaque outside 0 to 1; else the map repeats
};

/// A surface's material, from the MTL file. Only what an effect can read is kept.
struct Material {
  std::string name;
  float phong_exponent = -1.0f;  ///< Ns; negative: the material has no lobe (no Ns, or Ks 0 0 0)
  std::string opacity_map;       ///< map_d, path as resolved; empty: opaque
  MapLookup map = {};
};

/// An opacity map: a byte a texel, row 0 at the top (v = 1).
struct OpacityMap {
  std::string file;
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> opacity;
  MapLookup lookup = {};  ///< the channel, base and gain by which it was made, and clamp
};

/// What to keep of a mesh file; what no effect reads is not kept.
struct MeshAttributes {
  bool normals = true;
  bool uvs = false;
  bool materials = false;
  bool groups = false;
  bool exponents = false;  ///< materials' Ns are read: one that is no exponent is an error
};

/// Indexed triangles, shared by rays and SSAO.
///
/// With `instances`, `triangles` holds each distinct mesh once, in coordinates of its own (a model), and the
/// scene is its instances; without, the triangles lie in the world. Bounds are of the world in any case.
///
/// Invariants after loading: every index is in range; positions of every triangle are finite; `normals` are
/// unit length. A corner without a usable normal has index `no_normal`: it shades with the geometric normal.
/// `triangle_normals`, `triangle_uvs` and `triangle_material` are either empty (the mesh has none) or as long
/// as `triangles`.
struct TriangleMesh {
  static constexpr std::uint32_t no_normal = 0xffffffffu, no_uv = 0xffffffffu, no_material = 0xffffffffu;

  std::vector<vec3> positions;  ///< world units
  std::vector<vec3> normals;    ///< unit length
  std::vector<vec2> uvs;
  std::vector<std::array<std::uint32_t, 3>> triangles;         ///< indices into positions, counter-clockwise
  std::vector<std::array<std::uint32_t, 3>> triangle_normals;  ///< indices into normals, or no_normal
  std::vector<std::array<std::uint32_t, 3>> triangle_uvs;      ///< indices into uvs, or no_uv
  std::vector<std::uint32_t> triangle_material;                ///< index into materials, or no_material
  std::vector<std::uint32_t> triangle_group;                   ///< index into groups
  std::vector<Material> materials;
  std::vector<std::string> groups;
  /// The names by which a group's faces are known besides its own: a and b of "g a b". As long as `groups`,
  /// or empty.
  std::vector<std::vector<std::string>> group_names;
  /// A mesh that is placed, perhaps many times: a range of `triangles`, and of `positions` those that they
  /// use.
  struct Model {
    std::uint32_t first_triangle = 0, triangles = 0;
    std::uint32_t first_position = 0, positions = 0;
    Bounds3 bounds;         ///< of the positions that its triangles use, its own coordinates
    bool all_used = false;  ///< no position is without a triangle
  };
  struct Instance {    // NOLINT(cppcoreguidelines-pro-type-member-init): PlacedMesh is a struct of C
    PlacedMesh place;  ///< root and meshes are set by the tree's builder
    std::uint32_t model = 0;
  };
  std::vector<Model> models;
  std::vector<Instance> instances;
  std::vector<OpacityMap> opacity_maps;  ///< each once, if the scene asks for cut-outs
  Bounds3 bounds;                        ///< of the positions that triangles use
  Frame frame;                           ///< of positions and bounds; distances of a Scene are the file's
  Bounds3 subject;  ///< the bounds without the ground that a scene added; empty if there is none
  /// That ground, the last two triangles or the last instance.
  struct Ground {
    float height = 0, reach = 0;
    Axis up = Axis::y;
  } ground;
  /// What automatic distances and cameras refer to.
  const Bounds3& subject_bounds() const { return subject.empty() ? bounds : subject; }

  std::string why_copies;     ///< of a scene with instances that are copies: a reason, for people
  std::string why_no_ground;  ///< of a scene whose ground was left out: a reason, for people

  /// What the loader found and did; `nook info` prints it.
  struct Report {
    std::uint64_t triangles_read = 0;
    std::uint64_t non_finite_dropped = 0;  ///< triangles with a NaN or infinite vertex
    std::uint64_t normals_replaced = 0;    ///< corners whose normal was missing, zero or not finite
    std::uint64_t normals_normalised = 0;  ///< normals whose length was not 1 (within 1e-3)
    std::vector<std::string> warnings;     ///< a line each, "FILE:LINE: ..."
  } report;

  bool empty() const { return triangles.empty(); }
  /// Triangles in the world: those of a mesh placed twice count twice.
  std::uint64_t scene_triangles() const {
    if (instances.empty()) return triangles.size();
    const Instance& last = instances.back();
    return std::uint64_t(last.place.first_triangle) + models[last.model].triangles;
  }
  bool has_normals() const { return !triangle_normals.empty(); }
};

}  // namespace nook
