#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mesh/triangle_mesh.hpp"
#include "scene/scene.hpp"
#include "ssao/plan.hpp"

namespace nook {

/// What a frame is to hold beside the occlusion; read back only if asked for.
struct SsaoOutputs {
  bool positions = false;
  bool normals = false;
};

/// A pass and the time it took, ended by glFinish (GL timer queries are wrong on software renderers).
struct SsaoTiming {
  std::string pass;
  double seconds = 0;      ///< wall clock
  double cpu_seconds = 0;  ///< of all threads of the process: what a busy machine does not change much
};

/// A finished frame: planes of width * height values, row-major, row 0 at the top.
struct SsaoFrame {
  int width = 0, height = 0;
  std::vector<float> occlusion;  ///< 1 open, 0 occluded; background: 0, as where a camera ray misses
  std::vector<float> coverage;   ///< 1 where the pixel's centre sees the mesh, else 0
  std::vector<vec3> positions;   ///< world space; background: 0. Empty unless asked for
  std::vector<vec3> normals;     ///< shading normals, world space, unit, never flipped; background: 0
  std::vector<SsaoTiming> timings;
  double seconds = 0;  ///< of all passes and the read-back of the occlusion
};

/// Screen-space ambient occlusion of one mesh, by OpenGL. Holds the context and the mesh on the GL side, so
/// that further frames only draw. One thread at a time.
///
/// Methods (glsl/ssao.frag, gtao.frag, march.frag hold the equations): `point` tests 32 points at the radius
/// against the depth seen through their pixels; `gtao` integrates over slices through the view direction;
/// `march` follows rays.
class SsaoRenderer {
 public:
  /// Throws Error(device) with one line if there is no usable OpenGL.
  explicit SsaoRenderer(const TriangleMesh& mesh);
  ~SsaoRenderer();
  SsaoRenderer(SsaoRenderer&&) noexcept;
  SsaoRenderer& operator=(SsaoRenderer&&) noexcept;

  /// width, height: pixels, at least 1. Throws Error(scene) for settings or a camera that make no picture,
  /// and Error(device) if the image does not fit the device.
  SsaoFrame render(const Camera& camera, const SsaoSettings& settings, int width, int height,
                   const SsaoOutputs& outputs = {});
  SsaoFrame render(const Camera& camera, const SsaoPlan& plan, int width, int height,
                   const SsaoOutputs& outputs = {});

  const std::string& device() const;   ///< e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"
  const std::string& version() const;  ///< of OpenGL
  std::size_t mesh_bytes() const;      ///< uploaded for the mesh

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nook
