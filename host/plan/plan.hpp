#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kernels/shared/camera.h"
#include "mesh/obj_loader.hpp"
#include "mesh/triangle_mesh.hpp"
#include "plan/surface_sets.hpp"
#include "scene/scene.hpp"

namespace nook {

/// Samples a pixel may get, camera rays times directions: each adds up to 2^34 to a sum, which is signed for
/// bent normals, and the samplers number them in 32 bits.
constexpr std::uint64_t most_samples_per_pixel = std::uint64_t(1) << 28;

/// One effect as it will be computed.
struct EffectPlan {
  Effect effect;
  float max_distance = 0;   ///< resolved, world units; infinity if unlimited
  bool reach = false;       ///< points are asked whether anything is in reach before their rays are traced
  double weight_bound = 1;  ///< no sample's weight exceeds it
  float sum_scale = 1;      ///< of Film::sum
  float square_scale = 1;   ///< of Film::sum_square
  std::string layer;        ///< see LayerPlan::prefix
  std::size_t tree = 0;     ///< what occludes: 0: every triangle; i: Plan::occluder_sets[i - 1]
  TriangleBits receivers;   ///< where it is estimated; empty: everywhere

  /// The effect with the distance limit that holds, for reports.
  Effect resolved() const;
  /// "contact", or "ao" without a name: for reports.
  std::string label() const;
  /// Every setting of resolved(), as records name it: for Film::settings.
  std::map<std::string, std::string> settings() const;
  /// Planes of Film::extra.
  std::size_t extra_planes() const { return effect.kind == EffectKind::bent ? 3 : 0; }
};

/// One layer of the picture, in the scene's order.
struct LayerPlan {
  EffectKind kind = EffectKind::ao;
  std::string prefix;  ///< of its EXR channels: "contact."; empty for a main layer without a name
  bool main = false;   ///< R, G, B: the first layer (an SSAO layer only if there is nothing else)
};

/// Everything that follows from a scene and its mesh: scene -> plan -> kernels, buffers, launches.
struct Plan {
  CameraParams camera{};              ///< in `frame`
  Frame frame;                        ///< the mesh's; distances of effects are the file's
  int width = 0, height = 0;          ///< the whole image, pixels
  PixelRect window;                   ///< what is rendered of it
  std::uint32_t spp = 1;              ///< camera rays a pixel
  std::uint32_t directions = 1;       ///< occlusion rays per camera ray
  bool choose_directions = false;     ///< a pilot chooses them before the render; then a guess stands there
  bool replicate_directions = false;  ///< see Film
  Sampler sampler = Sampler::sobol;
  /// Given points in [0,1)^2 to take directions from instead, at point lists: each randomisation takes the
  /// whole set, and each row shifts it by a vector of its own, modulo 1 (Cranley and Patterson 1976).
  std::vector<vec2> point_set;
  bool shift_points = true;  ///< otherwise there is one randomisation, the set as it is at every row
  std::uint32_t seed = 0;
  bool vertex_normals = false;  ///< uploaded and interpolated
  bool materials = false;       ///< each triangle's material is uploaded, and surface points know theirs
  bool surface = false;         ///< the surface at the pixels' centres is read back: normal, position, depth
  /// Triangles from here on are a ground that the preview gives the background's color, which the surface at
  /// the pixels' centres is read back for.
  std::optional<std::uint32_t> preview_ground;
  bool cutouts = false;                                   ///< rays look up opacity maps
  bool denoise = false;                                   ///< the traced values are filtered
  bool instances = false;                                 ///< rays go through the trees of placed meshes
  std::vector<std::vector<std::uint32_t>> occluder_sets;  ///< triangles, each set once; a tree each
  std::vector<EffectPlan> effects;                        ///< those that rays estimate
  std::vector<SsaoSettings> ssao;                         ///< the screen-space ones
  std::vector<LayerPlan> layers;                          ///< all of them, as the picture holds them
  std::vector<float>
      exponents;  ///< Phong exponent by material, negative without a lobe; empty unless an effect reads it

  bool needs_opencl() const { return surface || !effects.empty(); }
  /// Some effect's surfaces are occluded by their own groups alone.
  bool only_self() const;
  /// Some effect's points are asked what is in reach.
  bool asks_reach() const;

  /// What a pixel's samples are counted in: camera rays or, with one camera ray a pixel, directions.
  std::uint32_t samples_per_pixel() const { return replicate_directions ? directions : spp; }
  /// The index in a film of the window of pixel y * width + x of the whole image.
  std::size_t film_index(std::uint32_t pixel) const {
    const int x = int(pixel % std::uint32_t(width)), y = int(pixel / std::uint32_t(width));
    return std::size_t(y - window.y0) * std::size_t(window.width()) + std::size_t(x - window.x0);
  }
};

/// What of the mesh file the scene's effects read. `surface`: normals are asked for beside the effects.
MeshAttributes needed_attributes(const Scene& scene, bool surface = false);

/// Throws Error(scene) if `spp` camera rays of the scene's directions are more than most_samples_per_pixel.
void check_samples(const Scene& scene, std::uint64_t spp);

/// The plan of a validated scene. `surface`: the surface at the pixels' centres is asked for beside the
/// effects. Throws Error(scene) if the mesh cannot carry it out (a lobe by material without materials, a set
/// of an unknown name).
Plan make_plan(const Scene& scene, const TriangleMesh& mesh, bool surface = false);

/// The radius of the sphere about the mesh without its ground, in the file's units.
float subject_radius(const TriangleMesh& mesh);

/// The distance limit in world units: half the `radius` of the bounding sphere for AO by default
/// (TinyRender's rule, read literally), 1.5 with compat = "tinyrender", infinity for RO.
float resolve_distance(const Effect& effect, float radius, bool compat_tinyrender);

/// Fixed-point scales for weights up to `weight_bound`: 2^28 samples of the largest weight fit 64 bits. RO:
/// the largest exponent that any surface has bounds the weight.
void choose_scales(EffectPlan& effect, float largest_exponent);

}  // namespace nook
