#pragma once

#include <memory>
#include <optional>

#include "mesh/triangle_mesh.hpp"
#include "ssao/gl_objects.hpp"
#include "ssao/mesh_vertices.hpp"
#include "ssao/view.hpp"

namespace nook {

/// The mesh on the GL side: positions and, interpolated or flat, normals.
class GlMesh {
 public:
  GlMesh(const GlContext& context, const TriangleMesh& mesh);

  bool smooth() const { return smooth_; }  ///< normals are interpolated; otherwise each triangle has one
  std::size_t bytes() const { return bytes_; }
  void draw() const;

 private:
  GlMesh(const GlContext& context, bool smooth, const MeshVertices& vertices);

  const GlContext& context_;
  bool smooth_;
  GLsizei index_count_;
  std::size_t bytes_;
  GlVertexArray vertices_;  // bound when the indices are made: it keeps them
  GlBuffer indices_;
};

/// The G-buffer: what the camera sees, pixel by pixel, and the solids behind it.
///
/// surface: inverse depth of the nearest surface, its change per pixel to the right and downwards, and the
/// inverse depth of the nearest back face. 0 where there is nothing.
///
/// With more than two layers the faces along each pixel's view ray are peeled off one by one, front and back
/// faces alike, and glsl/solids.frag makes solids of them: surface.a is then where the first one ends,
/// surface2 where the second and third begin and end.
///
/// normals: two 16-bit numbers (glsl/gbuffer.frag), within 4e-5 of the unit vector: a quarter of the memory
/// traffic. Positions and normals in full precision are there for the point method and for those who ask.
struct GBuffer {
  /// layers: 1, 2, or the faces that are peeled, up to most_layers.
  GBuffer(const GlContext& context, int width, int height, bool exact, int layers);
  static constexpr int most_layers = 9;

  /// The visible face, and inverse depths of the following ones, four to a texture, negative for back faces.
  struct Faces {
    Faces(const GlContext& context, int width, int height, const GlTexture& depth);
    GlTexture first, next[2];
    GlTexture depth;                              ///< in turns with GBuffer::depth
    std::unique_ptr<GlFramebuffer> target[2][2];  ///< [texture of `next`][0: depth here, 1: GBuffer::depth]
  };

  GlTexture surface, normals, depth;
  std::optional<GlTexture> position, exact_normals, surface2;
  std::optional<Faces> faces;
  std::unique_ptr<GlFramebuffer> front;   ///< surface or faces->first, normals, [position, exact normals]
  std::unique_ptr<GlFramebuffer> back;    ///< surface
  std::unique_ptr<GlFramebuffer> solids;  ///< surface, surface2
};

/// Draws the mesh into a G-buffer.
class GeometryPass {
 public:
  GeometryPass(const GlContext& context, const TriangleMesh& mesh);
  const GlMesh& mesh() const { return mesh_; }
  /// layers: as `buffer` was made with.
  void draw(const SsaoView& view, const GBuffer& buffer, int layers);

 private:
  enum class Pass { front, back, next_face };
  /// face: of next_face, from 1 on.
  void draw(Pass pass, const SsaoView& view, const GBuffer& buffer, int face);
  const GlProgram& program(Pass pass, bool exact);

  const GlContext& context_;
  GlMesh mesh_;
  float scale_;  ///< |eye| and the mesh's size bound the depths that matter
  vec3 center_;
  std::unique_ptr<GlProgram> programs_[4];
};

}  // namespace nook
