#pragma once

#include <functional>
#include <map>
#include <memory>

#include "ssao/geometry_pass.hpp"
#include "ssao/plan.hpp"

namespace nook {

/// Where the screen-space passes write: AO and inverse depth, two floats a pixel.
struct ShadingTargets {
  ShadingTargets(const GlContext& context, int width, int height, bool half_resolution);

  GlTexture shaded, filtered;  ///< of the shaded resolution; the passes alternate between them
  GlFramebuffer shaded_frame, filtered_frame;
  std::optional<GlTexture> full;  ///< after the upsample, if the shaded resolution is half
  std::optional<GlFramebuffer> full_frame;
};

/// The passes over the screen: the method's estimator, the denoiser, the upsample.
class ShadingPass {
 public:
  explicit ShadingPass(const GlContext& context);
  ShadingPass(const ShadingPass&) = delete;
  ShadingPass& operator=(const ShadingPass&) = delete;

  /// Returns the framebuffer that holds the result (red: AO, green: inverse depth). `done` is told of each
  /// finished pass.
  const GlFramebuffer& draw(const SsaoPlan& plan, const SsaoView& view, const GBuffer& buffer,
                            ShadingTargets& targets, const std::function<void(const char* pass)>& done);

 private:
  const GlProgram& use(const std::string& fragment, const GlProgram::Defines& defines, const SsaoView& view,
                       const GBuffer& buffer);
  void draw_quad(const GlFramebuffer& target);

  const GlContext& context_;
  GlVertexArray quad_;
  std::map<std::string, std::unique_ptr<GlProgram>> programs_;  ///< by fragment shader and defines
};

}  // namespace nook
