#include "ssao/shading_pass.hpp"

#include <cstdio>

namespace nook {
namespace {

using Method = SsaoSettings::Method;

int shaded_size(int size, bool half_resolution) {
  return half_resolution ? (size + 1) / 2 : size;
}

std::string number(float value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9e", double(value));
  return text;
}

std::string estimator_file(Method method) {
  switch (method) {
    case Method::point:
      return "glsl/ssao.frag";
    case Method::gtao:
      return "glsl/gtao.frag";
    case Method::march:
      return "glsl/march.frag";
  }
  return "";
}

GlProgram::Defines estimator_defines(const SsaoPlan& plan) {
  const std::string directions = std::to_string(plan.directions), steps = std::to_string(plan.steps);
  GlProgram::Defines defines = {{"STRIDE", plan.half_resolution ? "2" : "1"},
                                {"LAYERS", std::to_string(plan.layers)}};
  switch (plan.method) {
    case Method::point:
      defines.insert(defines.end(), {{"SAMPLES", directions},
                                     {"RANGE_CHECK", plan.range_check ? "1" : "0"},
                                     {"COSINE", plan.cosine ? "1" : "0"},
                                     {"AS_PUBLISHED", plan.as_published ? "1" : "0"},
                                     {"DENOISED", plan.denoise_radius > 0 ? "1" : "0"}});
      break;
    case Method::gtao:
      defines.insert(defines.end(), {{"SLICES", directions}, {"TAPS", steps}});
      break;
    case Method::march:
      defines.insert(defines.end(), {{"DIRECTIONS", directions}, {"STEPS", steps}, {"TOLERANCE", "1e-4"}});
      break;
  }
  return defines;
}

// Position and uv of a triangle strip; rows run downwards (glClipControl), so that v = 0 is the top row.
constexpr float quad_corners[] = {-1, 1, 0, 0, 1, 1, 1, 0, -1, -1, 0, 1, 1, -1, 1, 1};

}  // namespace

ShadingTargets::ShadingTargets(const GlContext& context, int width, int height, bool half_resolution)
    : shaded(context, GL_RG32F, shaded_size(width, half_resolution), shaded_size(height, half_resolution)),
      filtered(context, GL_RG32F, shaded.width(), shaded.height()),
      shaded_frame(context, {&shaded}, nullptr),
      filtered_frame(context, {&filtered}, nullptr) {
  if (half_resolution) {
    full.emplace(context, GL_RG32F, width, height);
    full_frame.emplace(context, std::initializer_list<const GlTexture*>{&*full}, nullptr);
  }
}

ShadingPass::ShadingPass(const GlContext& context)
    : context_(context), quad_(context, quad_corners, {2, 2}) {}

const GlProgram& ShadingPass::use(const std::string& fragment, const GlProgram::Defines& defines,
                                  const SsaoView& view, const GBuffer& buffer) {
  std::string key = fragment;
  for (const auto& [name, value] : defines) key += " " + name + "=" + value;
  std::unique_ptr<GlProgram>& program = programs_[key];
  if (!program)
    program = std::make_unique<GlProgram>(context_, "glsl/quad.vert", fragment, "glsl/view.glsl", defines);
  program->use();
  program->set("ray_scale", view.ray_scale.x, view.ray_scale.y);
  program->set("ray_offset", view.ray_offset.x, view.ray_offset.y);
  program->set("buffer_size", view.buffer_width(), view.buffer_height());
  program->set("guard", view.guard);
  program->bind("surface", 0, buffer.surface);
  return *program;
}

void ShadingPass::draw_quad(const GlFramebuffer& target) {
  target.bind();
  quad_.bind();
  context_.functions().glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

const GlFramebuffer& ShadingPass::draw(const SsaoPlan& plan, const SsaoView& view, const GBuffer& buffer,
                                       ShadingTargets& targets,
                                       const std::function<void(const char* pass)>& done) {
  if (buffer.faces) {
    const GlProgram& program =
        use("glsl/solids.frag", {{"FACES", std::to_string(plan.layers)}}, view, buffer);
    program.bind("first", 1, buffer.faces->first);
    program.bind("next4", 2, buffer.faces->next[0]);
    program.bind("next8", 3, buffer.faces->next[1]);
    program.set("thickness", plan.thickness * plan.radius);
    draw_quad(*buffer.solids);
    done("solids");
  }
  {
    const GlProgram& program = use(estimator_file(plan.method), estimator_defines(plan), view, buffer);
    program.bind("normals", 1, buffer.normals);
    if (plan.method == Method::point) {
      program.bind("positions", 2, *buffer.position);
      program.bind("exact_normals", 4, *buffer.exact_normals);
    }
    if (plan.layers > 2) program.bind("surface2", 3, *buffer.surface2);
    program.set("shaded_size", targets.shaded.width(), targets.shaded.height());
    program.set("radius", plan.radius);
    program.set("bias", plan.bias);
    draw_quad(targets.shaded_frame);
    done("occlusion");
  }
  const std::string stride = plan.half_resolution ? "2" : "1";
  if (plan.denoise_radius > 0) {
    const GlProgram& program = use("glsl/denoise.frag",
                                   {{"STRIDE", stride},
                                    {"DENOISE_RADIUS", std::to_string(plan.denoise_radius)},
                                    {"HALF_ENDS", "1"},
                                    {"DEPTH_TOLERANCE", number(plan.depth_tolerance)},
                                    {"BY_NORMAL", plan.normal_tolerance > 0 ? "1" : "0"},
                                    {"NORMAL_TOLERANCE", number(plan.normal_tolerance)}},
                                   view, buffer);
    program.bind("normals", 2, buffer.normals);
    program.set("image_size", targets.shaded.width(), targets.shaded.height());
    program.set("direction", 1, 0);
    program.bind("occlusion", 1, targets.shaded);
    draw_quad(targets.filtered_frame);
    program.set("direction", 0, 1);
    program.bind("occlusion", 1, targets.filtered);
    draw_quad(targets.shaded_frame);
    done("denoise");
  }
  if (!plan.half_resolution) return targets.shaded_frame;
  const GlProgram& program =
      use("glsl/upsample.frag", {{"DEPTH_TOLERANCE", number(plan.depth_tolerance)}}, view, buffer);
  program.set("image_size", targets.shaded.width(), targets.shaded.height());
  program.bind("occlusion", 1, targets.shaded);
  draw_quad(*targets.full_frame);
  done("upsample");
  return *targets.full_frame;
}

}  // namespace nook
