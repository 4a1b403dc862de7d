#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kernels/shared/camera.h"
#include "mesh/triangle_mesh.hpp"
#include "scene/scene.hpp"

namespace nook {

/// One effect as it will be computed.
struct EffectPlan {
  Effect effect;
  float max_distance = 0;         ///< resolved, world units; infinity if unlimited
  double weight_bound = 1;        ///< no sample's weight exceeds it
  float sum_scale = 1;            ///< of Film::sum
  float square_scale = 1;         ///< of Film::sum_square
};

/// Everything that follows from a scene and its mesh: scene -> plan -> kernels, buffers, launches.
struct Plan {
  CameraParams camera{};
  int width = 0, height = 0;         ///< the whole image, pixels
  PixelRect window;                  ///< what is rendered of it
  std::uint32_t spp = 1;             ///< camera rays a pixel
  std::uint32_t directions = 1;      ///< occlusion rays per camera ray
  bool replicate_directions = false; ///< see Film
  Sampler sampler = Sampler::sobol;
  std::uint32_t seed = 0;
  bool vertex_normals = false;       ///< uploaded and interpolated
  std::vector<EffectPlan> effects;   ///< the path-traced ones

  /// What a pixel's samples are counted in: camera rays or, with one camera ray a pixel, directions.
  std::uint32_t samples_per_pixel() const { return replicate_directions ? directions : spp; }
  /// The index in a film of the window of pixel y * width + x of the whole image.
  std::size_t film_index(std::uint32_t pixel) const {
    const int x = int(pixel % std::uint32_t(width)), y = int(pixel / std::uint32_t(width));
    return std::size_t(y - window.y0) * std::size_t(window.width()) + std::size_t(x - window.x0);
  }
};

/// Which attributes of the mesh the scene's effects read.
struct MeshNeeds {
  bool normals = false, uvs = false, materials = false, groups = false;
};

/// The plan of a validated scene. Throws Error(scene) if the mesh cannot carry it out (a lobe by material without materials).
Plan make_plan(const Scene& scene, const TriangleMesh& mesh);

/// The camera as the kernels use it. `scene` must be validated; the automatic camera frames `bounds`.
CameraParams camera_params(const Scene& scene, const Bounds3& bounds);

/// The distance limit in world units: half the radius of the bounding sphere for AO by default (TinyRender's rule, read
/// literally), 1.5 with compat = "tinyrender", infinity for RO.
float resolve_distance(const Effect& effect, const Bounds3& bounds, bool compat_tinyrender);

/// Fixed-point scales for weights up to `weight_bound`: 2^28 samples of the largest weight fit 64 bits.
void choose_scales(EffectPlan& effect);

}  // namespace nook
