#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "math/axis.hpp"
#include "math/background.hpp"
#include "math/types.hpp"

namespace nook {

/// Pinhole camera, TinyRender's: right-handed, looking along at - eye, row 0 at the top.
struct Camera {
  dvec3 eye{1, 1, 0};
  dvec3 at{0, 0, 0};
  vec3 up{0, 1, 0};
  float fov = 30;  ///< vertical, degrees, in (0, 180)
};

/// Where a camera that frames the mesh stands, as seen from it: degrees from its front towards its right,
/// and above its horizon, from -90 to 90. See plan/framing.hpp for which side is the front.
struct View {
  double azimuth = 30, elevation = 25;
  bool operator==(const View&) const = default;
};

/// Pixels [x0, x1) x [y0, y1), row 0 at the top.
struct PixelRect {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool operator==(const PixelRect&) const = default;
};

/// How far an occlusion ray looks.
struct DistanceLimit {
  enum class Kind { automatic, none, value };
  Kind kind = Kind::automatic;
  float value = 0;  ///< world units, for Kind::value

  bool operator==(const DistanceLimit&) const = default;
};

enum class EffectKind { ao, ro, ssao, normal, position, depth, bent };
/// The distribution that directions are drawn from. `lobe` and `mixture` are for RO alone.
enum class Sampling { cosine, hemisphere, sphere, lobe, mixture };
/// The point sequence; see kernels/sample/sampler.cl.
enum class Sampler { independent, stratified, halton, sobol, zorder };

/// How an occluder's distance counts; see kernels/effect/visibility.cl.
enum class Falloff { none, linear, smooth, exponential };
/// The side of the surface that occlusion looks to: the shading normal's, the other, or the viewer's.
enum class Side { normal, inside, viewer };

/// Screen-space AO; see ssao/ssao.hpp for what the methods compute.
struct SsaoSettings {
  enum class Method { point, gtao, march };
  enum class Quality { draft, real_time, accurate };
  Method method = Method::point;
  std::optional<Quality> quality;  ///< unset: the method as the assignment has it
  float radius = 0.15f;            ///< world units; 0: half the radius of the bounding sphere
  float bias = 0.0f;               ///< world units
  int samples = 32;                ///< directions a pixel, 1 to 32
  bool range_check = false;        ///< point: ignore occluders beyond the radius
};

/// One thing that the scene asks for.
struct Effect {
  EffectKind kind = EffectKind::ao;
  std::string name;  ///< EXR layer; empty: the default layer (R, G, B)
  Sampling sampling = Sampling::cosine;
  bool uniform_weight = false;  ///< AO, bent: every open direction counts alike, not by its cosine
  DistanceLimit max_distance;
  float exponent = 30;                ///< RO: Phong exponent, 0 to 1e7
  bool exponent_of_material = false;  ///< RO: use the MTL's Ns
  Falloff falloff = Falloff::none;
  float min_distance = 0;  ///< world units; nearer surfaces do not occlude
  float cone_angle = 90;   ///< AO, bent: half-angle of the cone about the normal, degrees, in (0, 90]
  Side side = Side::normal;
  bool view_space = false;  ///< bent: along the camera's right, up and back axes instead of the world's
  /// Names of OBJ groups and materials: what occludes, and where the effect is estimated. Empty: everything.
  std::vector<std::string> occluders, receivers;
  bool only_self = false;  ///< nothing occludes a surface but its own OBJ group
  SsaoSettings ssao;
  std::uint64_t given = 0;  ///< a bit for each of effect_keys() that a scene or a flag named
};

/// Effects that trace occlusion rays.
inline bool is_traced(EffectKind kind) {
  return kind == EffectKind::ao || kind == EffectKind::ro || kind == EffectKind::bent;
}

/// What the camera sees, without occlusion: normal, position, depth.
inline bool is_surface(EffectKind kind) {
  return kind == EffectKind::normal || kind == EffectKind::position || kind == EffectKind::depth;
}

/// A copy of a mesh file: p -> translate + Rz Ry Rx scale p.
struct Instance {
  std::filesystem::path mesh_file;
  dvec3 translate{0};  ///< world units
  vec3 rotate{0};      ///< degrees about x, then y, then z
  vec3 scale{1};
};

/// How the instances are kept: as copies of their meshes' triangles, or as a tree for each mesh and one over
/// the places; the same picture. Automatic: see plan/scene_mesh.hpp.
enum class Instancing { automatic, copies, tree };

/// A large square below everything. What is unset follows from mesh and camera: see plan/scene_ground.hpp.
struct Ground {
  bool none = false;             ///< there is none
  std::optional<double> height;  ///< along `up`'s axis, world units
  std::optional<float> reach;    ///< from the mesh's center to each side, world units
  std::optional<Axis> up;        ///< the side that it faces
};

/// When a render ends, if not after a fixed number of samples; see docs/study.md.
struct StopTarget {
  std::optional<double> error;    ///< standard error of each pixel, 1e-4 to 1
  std::optional<double> seconds;  ///< from the start of the command, 0.05 to 1e7
  double confidence = 0.95;       ///< of the intervals behind `error`, 0.5 to 0.9999
  std::uint32_t min_spp = 16;     ///< with `error`: camera rays before a pixel may stop
  std::uint32_t max_spp = 65536;  ///< camera rays a pixel at most; min_spp <= max_spp

  bool any() const { return error || seconds; }
};

/// What a scene file says, checked and complete; nothing is derived yet (see plan/plan.hpp).
struct Scene {
  std::filesystem::path file;       ///< as the user named it; for messages
  std::filesystem::path mesh_file;  ///< resolved against the scene file's folder
  std::vector<Instance> instances;  ///< if any, they are the scene, and mesh_file is the first one's
  Instancing instancing = Instancing::automatic;
  std::optional<Ground> ground;
  bool cutouts = false;  ///< materials' opacity maps (map_d) cut holes
  Camera camera;
  bool automatic_camera = false;  ///< frame the mesh, from `view`, camera.up above: eye and at follow
  View view;
  float margin = 0.08f;  ///< of a framed picture, on each side, as a share of its width and height
  Background background;
  int width = 768, height = 576;  ///< pixels
  std::optional<PixelRect> crop;
  bool realtime = false;
  std::vector<Effect> effects;   ///< at least one
  std::uint32_t spp = 1;         ///< camera rays a pixel
  std::uint32_t directions = 1;  ///< occlusion rays per camera ray, where they are not chosen
  /// by_target: chosen if the scene renders to an error with a point sequence that stratifies them.
  enum class DirectionChoice { by_target, given, automatic } direction_choice = DirectionChoice::by_target;
  Sampler sampler = Sampler::sobol;
  std::uint32_t seed = 0;
  StopTarget stop;
  bool compat_tinyrender = false;  ///< automatic AO limit 1.5, as the course's images have
  bool denoise = false;            ///< filter what is traced; see image/denoise.hpp

  /// Whether a pilot chooses the directions; see adaptive/directions.hpp.
  bool chooses_directions() const {
    if (direction_choice == DirectionChoice::by_target)
      return stop.error && (sampler == Sampler::sobol || sampler == Sampler::halton);
    return direction_choice == DirectionChoice::automatic;
  }
};

/// True if all that the scene asks for is SSAO: nothing of OpenCL is loaded then, and no tree is built.
inline bool is_ssao_alone(const Scene& scene) {
  return std::all_of(scene.effects.begin(), scene.effects.end(),
                     [](const Effect& e) { return e.kind == EffectKind::ssao; });
}

}  // namespace nook
