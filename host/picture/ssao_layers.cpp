#include "picture/ssao_layers.hpp"

#include <algorithm>
#include <limits>

#include "base/error.hpp"
#include "base/stopwatch.hpp"
#include "plan/scene_camera.hpp"
#include "scene/layer_names.hpp"
#include "scene/names.hpp"
#include "ssao/ssao.hpp"

namespace nook {
namespace {

// The window of a plane of the whole image.
template <class Get>
std::vector<float> cut(const Plan& plan, Get get) {
  std::vector<float> values;
  values.reserve(std::size_t(plan.window.width()) * std::size_t(plan.window.height()));
  for (int y = plan.window.y0; y < plan.window.y1; ++y)
    for (int x = plan.window.x0; x < plan.window.x1; ++x)
      values.push_back(get(std::size_t(y) * std::size_t(plan.width) + std::size_t(x)));
  return values;
}

void add_vectors(const Plan& plan, const std::string& layer, const std::vector<vec3>& values, Image& image) {
  static constexpr const char* axes[] = {".X", ".Y", ".Z"};
  for (int axis = 0; axis < 3; ++axis)
    image.channels.push_back({layer + axes[axis], cut(plan, [&](std::size_t i) { return values[i][axis]; })});
}

void add_surface(const Plan& plan, const AovRequest& aovs, const SsaoFrame& frame, Image& image) {
  if (aovs.alpha)
    image.channels.push_back({"A", cut(plan, [&](std::size_t i) { return frame.coverage[i]; })});
  if (aovs.normal) add_vectors(plan, "N", frame.normals, image);
  std::vector<vec3> positions = frame.positions;
  for (vec3& p : positions) p = vec3(plan.frame.to_file(dvec3(p)));
  if (aovs.position) add_vectors(plan, "P", positions, image);
  const vec3 eye(plan.camera.eye[0], plan.camera.eye[1], plan.camera.eye[2]);
  const vec3 forward(plan.camera.forward[0], plan.camera.forward[1], plan.camera.forward[2]);
  if (aovs.depth)
    image.channels.push_back({"Z", cut(plan, [&](std::size_t i) {
                                if (!(frame.coverage[i] > 0)) return std::numeric_limits<float>::infinity();
                                const float z = glm::dot(frame.positions[i] - eye, forward);
                                return float(plan.frame.to_file(double(z)));
                              })});
}

void keep_fastest(SsaoRecord& record, const SsaoFrame& frame) {
  if (record.passes.empty()) {
    record.passes = frame.timings;
    record.seconds_per_frame = frame.seconds;
  }
  for (std::size_t i = 0; i < record.passes.size(); ++i)
    record.passes[i].seconds = std::min(record.passes[i].seconds, frame.timings[i].seconds);
  record.seconds_per_frame = std::min(record.seconds_per_frame, frame.seconds);
}

}  // namespace

SsaoLayers draw_ssao(const Scene& scene, const TriangleMesh& mesh, const Plan& plan, const AovRequest& aovs,
                     unsigned frames, Image& image) {
  const bool alone = !plan.needs_opencl();
  if (alone && (aovs.variance || aovs.samples))
    throw Error(ErrorKind::usage, "--aov: SSAO has no variance and no samples channel");
  const Stopwatch watch;
  SsaoRenderer renderer(mesh);
  if (alone) {
    image.width = plan.window.width();
    image.height = plan.window.height();
  }
  SsaoLayers layers{{}, renderer.device(), renderer.version(), renderer.mesh_bytes(), 0};
  std::size_t layer_index = 0;
  for (const SsaoSettings& settings : plan.ssao) {
    while (plan.layers[layer_index].kind != EffectKind::ssao) ++layer_index;
    const LayerPlan& layer = plan.layers[layer_index++];
    SsaoRecord& drawn = layers.effects.emplace_back();
    drawn.name = effect_label(layer.kind, layer.prefix);
    drawn.settings = settings;
    SsaoSettings in_memory = settings;
    in_memory.radius = float(mesh.frame.from_file(double(settings.radius)));
    in_memory.bias = float(mesh.frame.from_file(double(settings.bias)));
    drawn.plan = plan_ssao(in_memory, mesh.subject_bounds());
    drawn.plan.as_published = scene.compat_tinyrender && !settings.quality;
    drawn.frames = frames;
    const bool surface = alone && layers.effects.size() == 1;
    const SsaoOutputs outputs{.positions = surface && (aovs.position || aovs.depth),
                              .normals = surface && aovs.normal};
    SsaoFrame frame;
    for (unsigned i = 0; i < frames; ++i) {
      frame = renderer.render(in_frame(resolve_camera(scene, mesh), mesh.frame), drawn.plan, scene.width,
                              scene.height, outputs);
      keep_fastest(drawn, frame);
    }
    drawn.plan.radius = float(mesh.frame.to_file(double(drawn.plan.radius)));  // for people
    const std::vector<float> value = cut(plan, [&](std::size_t i) { return frame.occlusion[i]; });
    for (const char* channel : {"R", "G", "B"})
      image.channels.push_back({(layer.main ? "" : layer.prefix) + channel, value});
    if (alone && image.coverage.empty())
      image.coverage = cut(plan, [&](std::size_t i) { return frame.coverage[i]; });
    if (surface) add_surface(plan, aovs, frame, image);
  }
  layers.seconds = watch.seconds();
  return layers;
}

}  // namespace nook
