#pragma once

#include <memory>
#include <optional>

#include "mesh/triangle_mesh.hpp"
#include "ssao/gl_objects.hpp"
#include "ssao/view.hpp"

namespace nook {

/// The mesh on the GL side: positions and, interpolated or flat, normals.
class GlMesh {
 public:
  GlMesh(const GlContext& context, const TriangleMesh& mesh);
  ~GlMesh();
  GlMesh(const GlMesh&) = delete;
  GlMesh& operator=(const GlMesh&) = delete;

  bool smooth() const { return smooth_; }  ///< normals are interpolated; otherwise each triangle has one
  std::size_t bytes() const { return bytes_; }
  void draw() const;

 private:
  const GlContext& context_;
  GLuint vertex_array_ = 0;
  std::unique_ptr<GlBuffer> vertices_, indices_;
  GLsizei index_count_ = 0;
  bool smooth_;
  std::size_t bytes_ = 0;
};

/// The G-buffer: what the camera sees, pixel by pixel, in up to four depth layers.
///
/// surface: inverse depth of the nearest surface, its change per pixel to the right and downwards, and the
/// inverse depth of the nearest back face; surface2: the same of what lies behind that. 0 where there is
/// nothing.
///
/// normals: two 16-bit numbers (glsl/gbuffer.frag), within 4e-5 of the unit vector: a quarter of the memory
/// traffic. Positions and normals in full precision are there for the point method and for those who ask.
struct GBuffer {
  GBuffer(const GlContext& context, int width, int height, bool exact, int layers);

  GlTexture surface, normals, depth;
  std::optional<GlTexture> position, exact_normals, surface2;
  std::unique_ptr<GlFramebuffer> front;   ///< surface, normals, [position, exact normals]
  std::unique_ptr<GlFramebuffer> back;    ///< surface
  std::unique_ptr<GlFramebuffer> second;  ///< surface2
};

/// Draws the mesh into a G-buffer.
class GeometryPass {
 public:
  GeometryPass(const GlContext& context, const TriangleMesh& mesh);
  const GlMesh& mesh() const { return mesh_; }
  /// layers: 1, 2 or 4. `buffer` must have been made with at least as many.
  void draw(const SsaoView& view, const GBuffer& buffer, int layers);

 private:
  enum class Pass { front, back, second_front, second_back };
  void draw(Pass pass, const SsaoView& view, const GBuffer& buffer);
  const GlProgram& program(Pass pass, bool exact);

  const GlContext& context_;
  GlMesh mesh_;
  float scale_;  ///< |eye| and the mesh's size bound the depths that matter
  vec3 center_;
  std::unique_ptr<GlProgram> programs_[5];
};

}  // namespace nook
