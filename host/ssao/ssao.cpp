#include "ssao/ssao.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "base/error.hpp"
#include "ssao/geometry_pass.hpp"
#include "ssao/shading_pass.hpp"

namespace nook {
namespace {

// Ends each pass with glFinish and notes how long it took.
class PassTimer {
 public:
  PassTimer(const GlContext& context, std::vector<SsaoTiming>& timings)
      : context_(context), timings_(timings) {
    context.functions().glFinish();
    last_ = Clock::now();
    last_cpu_ = cpu_seconds();
  }
  void lap(const char* pass) {
    context_.functions().glFinish();
    const Clock::time_point now = Clock::now();
    const double cpu = cpu_seconds();
    timings_.push_back({pass, std::chrono::duration<double>(now - last_).count(), cpu - last_cpu_});
    last_ = now;
    last_cpu_ = cpu;
  }

 private:
  using Clock = std::chrono::steady_clock;
  static double cpu_seconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
  }
  const GlContext& context_;
  std::vector<SsaoTiming>& timings_;
  Clock::time_point last_;
  double last_cpu_ = 0;
};

// Pixels of guard band: as far as the radius reaches at the depth nearest to the camera, at most the plan's
// share.
int guard_pixels(const SsaoPlan& plan, const Camera& camera, int width, int height, const Bounds3& bounds) {
  const int most = int(std::ceil(plan.guard * float(height)));
  if (most == 0 || bounds.empty()) return 0;
  const SsaoView view = make_ssao_view(camera, width, height, 0);
  float nearest = std::numeric_limits<float>::infinity();
  for (int corner = 0; corner < 8; ++corner) {
    const vec3 p(corner & 1 ? bounds.lo.x : bounds.hi.x, corner & 2 ? bounds.lo.y : bounds.hi.y,
                 corner & 4 ? bounds.lo.z : bounds.hi.z);
    nearest = std::min(nearest, -view.to_view(p).z);
  }
  const float reach = plan.radius / (view.ray_scale.x * nearest);
  return nearest > 0 && reach < float(most) ? int(std::ceil(reach)) : most;
}

std::vector<vec3> to_world(const SsaoView& view, const std::vector<float>& rgba, bool directions) {
  std::vector<vec3> values(rgba.size() / 4);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const vec3 v(rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]);
    if (rgba[4 * i + 3] > 0) values[i] = directions ? view.direction_to_world(v) : view.to_world(v);
  }
  return values;
}

}  // namespace

struct SsaoRenderer::State {
  explicit State(const TriangleMesh& mesh)
      : context(make_gl_context()), geometry(*context, mesh), shading(*context), bounds(mesh.bounds) {}

  std::unique_ptr<GlContext> context;
  GeometryPass geometry;
  ShadingPass shading;
  Bounds3 bounds;

  // Buffers of the last frame, kept for the next of the same shape.
  struct Shape {
    int width, height, guard, layers;
    bool exact, half_resolution;
    bool operator==(const Shape&) const = default;
  };
  Shape shape{};
  std::unique_ptr<GBuffer> buffer;
  std::unique_ptr<ShadingTargets> targets;
};

SsaoRenderer::SsaoRenderer(const TriangleMesh& mesh) : state_(std::make_unique<State>(mesh)) {}
SsaoRenderer::~SsaoRenderer() = default;
SsaoRenderer::SsaoRenderer(SsaoRenderer&&) noexcept = default;
SsaoRenderer& SsaoRenderer::operator=(SsaoRenderer&&) noexcept = default;
const std::string& SsaoRenderer::device() const {
  return state_->context->renderer();
}
const std::string& SsaoRenderer::version() const {
  return state_->context->version();
}
std::size_t SsaoRenderer::mesh_bytes() const {
  return state_->geometry.mesh().bytes();
}

SsaoFrame SsaoRenderer::render(const Camera& camera, const SsaoSettings& settings, int width, int height,
                               const SsaoOutputs& outputs) {
  return render(camera, plan_ssao(settings, state_->bounds), width, height, outputs);
}

SsaoFrame SsaoRenderer::render(const Camera& camera, const SsaoPlan& plan, int width, int height,
                               const SsaoOutputs& outputs) {
  State& s = *state_;
  s.context->make_current();
  const SsaoView view =
      make_ssao_view(camera, width, height, guard_pixels(plan, camera, width, height, s.bounds));
  GLint largest = 0;
  s.context->functions().glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (std::max(view.buffer_width(), view.buffer_height()) > largest)
    throw Error(ErrorKind::device, "SSAO of " + std::to_string(width) + "x" + std::to_string(height) +
                                       " pixels does not fit: OpenGL takes at most " +
                                       std::to_string(largest) + " pixels on a side, guard band included");
  const bool exact = plan.method == SsaoSettings::Method::point || outputs.positions || outputs.normals;
  const State::Shape shape{width, height, view.guard, plan.layers, exact, plan.half_resolution};
  if (!s.buffer || shape != s.shape) {
    s.buffer = nullptr;
    s.targets = nullptr;
    s.buffer =
        std::make_unique<GBuffer>(*s.context, view.buffer_width(), view.buffer_height(), exact, plan.layers);
    s.targets = std::make_unique<ShadingTargets>(*s.context, width, height, plan.half_resolution);
    s.shape = shape;
  }

  SsaoFrame frame;
  frame.width = width;
  frame.height = height;
  PassTimer watch(*s.context, frame.timings);
  s.geometry.draw(view, *s.buffer, plan.layers);
  watch.lap("geometry");
  const GlFramebuffer& result =
      s.shading.draw(plan, view, *s.buffer, *s.targets, [&](const char* pass) { watch.lap(pass); });
  const std::vector<float> values = result.read(0, 2, 0, 0, width, height);
  frame.occlusion.resize(values.size() / 2);
  frame.coverage.resize(frame.occlusion.size());
  for (std::size_t i = 0; i < frame.occlusion.size(); ++i) {
    frame.occlusion[i] = values[2 * i];
    frame.coverage[i] = values[2 * i + 1] > 0 ? 1.0f : 0.0f;
  }
  watch.lap("read");
  for (const SsaoTiming& timing : frame.timings) frame.seconds += timing.seconds;
  if (outputs.positions)
    frame.positions =
        to_world(view, s.buffer->front->read(2, 4, view.guard, view.guard, width, height), false);
  if (outputs.normals)
    frame.normals = to_world(view, s.buffer->front->read(3, 4, view.guard, view.guard, width, height), true);
  return frame;
}

}  // namespace nook
