#include "ssao/geometry_pass.hpp"

#include <algorithm>
#include <array>

#include "base/error.hpp"

namespace nook {
GlMesh::GlMesh(const GlContext& context, const TriangleMesh& mesh)
    : GlMesh(context, mesh.has_normals(), mesh_vertices(mesh)) {}

GlMesh::GlMesh(const GlContext& context, bool smooth, const MeshVertices& vertices)
    : context_(context),
      smooth_(smooth),
      index_count_(GLsizei(vertices.triangles.size() * 3)),
      bytes_(vertices.bytes()),
      vertices_(context, vertices.values, {3, 3}),
      indices_(context, GL_ELEMENT_ARRAY_BUFFER, vertices.triangles.data(), vertices.triangle_bytes()) {
  context.check("uploading the mesh");
}

void GlMesh::draw() const {
  vertices_.bind();
  context_.functions().glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
}

GBuffer::Faces::Faces(const GlContext& context, int width, int height, const GlTexture& other_depth)
    : first(context, GL_RGBA32F, width, height),
      next{{context, GL_RGBA32F, width, height}, {context, GL_RGBA32F, width, height}},
      depth(context, GL_DEPTH_COMPONENT32F, width, height) {
  for (int texture = 0; texture < 2; ++texture)
    for (int turn = 0; turn < 2; ++turn)
      target[texture][turn].reset(
          new GlFramebuffer(context, {&next[texture]}, turn == 0 ? &depth : &other_depth));
}

GBuffer::GBuffer(const GlContext& context, int width, int height, bool exact, int layers)
    : surface(context, GL_RGBA32F, width, height),
      normals(context, GL_RG16, width, height),
      depth(context, GL_DEPTH_COMPONENT32F, width, height) {
  if (layers == 2) back.reset(new GlFramebuffer(context, {&surface}, &depth));
  if (layers > 2) {
    faces.emplace(context, width, height, depth);
    surface2.emplace(context, GL_RGBA32F, width, height);
    solids.reset(new GlFramebuffer(context, {&surface, &*surface2}, nullptr));
  }
  const GlTexture& visible = faces ? faces->first : surface;
  if (exact) {
    position.emplace(context, GL_RGBA32F, width, height);
    exact_normals.emplace(context, GL_RGBA32F, width, height);
    front.reset(new GlFramebuffer(context, {&visible, &normals, &*position, &*exact_normals}, &depth));
  } else {
    front.reset(new GlFramebuffer(context, {&visible, &normals}, &depth));
  }
}

GeometryPass::GeometryPass(const GlContext& context, const TriangleMesh& mesh)
    : context_(context), mesh_(context, mesh), scale_(mesh.bounds.bounding_radius()), center_(0) {
  if (!mesh.bounds.empty()) center_ = mesh.bounds.center();
}

const GlProgram& GeometryPass::program(Pass pass, bool exact) {
  const bool front = pass == Pass::front;
  std::unique_ptr<GlProgram>& program = programs_[front && exact ? 3 : int(pass)];
  if (!program)
    program =
        std::make_unique<GlProgram>(context_, "glsl/gbuffer.vert", "glsl/gbuffer.frag", "",
                                    GlProgram::Defines{{"PEEL", pass == Pass::next_face ? "1" : "0"},
                                                       {"FRONT", front ? "1" : "0"},
                                                       {"NORMAL", front ? "1" : "0"},
                                                       {"EXACT", front && exact ? "1" : "0"},
                                                       {"NORMAL_KIND", mesh_.smooth() ? "smooth" : "flat"}});
  return *program;
}

void GeometryPass::draw(const SsaoView& view, const GBuffer& buffer, int layers) {
  draw(Pass::front, view, buffer, 0);
  if (layers == 2) draw(Pass::back, view, buffer, 0);
  if (layers > 2)
    for (int face = 1; face < layers; ++face) draw(Pass::next_face, view, buffer, face);
}

void GeometryPass::draw(Pass pass, const SsaoView& view, const GBuffer& buffer, int face) {
  const GlFunctions& gl = context_.functions();
  // A framebuffer holds what the pass writes and no more: outputs that a shader lacks are undefined.
  const int channel = (face - 1) % 4, turn = (face - 1) % 2;
  const GlFramebuffer& target = pass == Pass::next_face ? *buffer.faces->target[(face - 1) / 4][turn]
                                : pass == Pass::back    ? *buffer.back
                                                        : *buffer.front;
  target.bind();
  gl.glEnable(GL_DEPTH_TEST);
  gl.glDepthFunc(GL_GREATER);
  // The back layer is drawn into the alpha channel of the front layer's texture, with a depth buffer of its
  // own.
  if (pass == Pass::back) {
    gl.glEnable(GL_CULL_FACE);
    gl.glCullFace(GL_FRONT);
    gl.glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
  }
  if (pass == Pass::next_face) gl.glColorMask(channel == 0, channel == 1, channel == 2, channel == 3);
  const float zero[4] = {0, 0, 0, 0};
  // Positions are cleared to a far depth, so that the background is behind everything.
  const float far_position[4] = {0, 0, -1e9f, 0};
  gl.glClearBufferfv(GL_DEPTH, 0, zero);
  // Packed normals are not cleared: nobody reads them in the background.
  if (pass != Pass::back) gl.glClearBufferfv(GL_COLOR, 0, zero);
  if (pass == Pass::front && buffer.position) {
    gl.glClearBufferfv(GL_COLOR, 2, far_position);
    gl.glClearBufferfv(GL_COLOR, 3, zero);
  }
  const GlProgram& program = this->program(pass, bool(buffer.position));
  program.use();
  program.set("eye", view.eye.x, view.eye.y, view.eye.z);
  program.set("right", view.right.x, view.right.y, view.right.z);
  program.set("up", view.up.x, view.up.y, view.up.z);
  program.set("backward", view.backward.x, view.backward.y, view.backward.z);
  program.set("ray_scale", view.ray_scale.x, view.ray_scale.y);
  program.set("ray_offset", view.ray_offset.x, view.ray_offset.y);
  program.set("buffer_size", float(view.buffer_width()), float(view.buffer_height()));
  program.set("near", 1e-6f * (scale_ + glm::length(view.eye - center_)));
  if (pass == Pass::next_face) program.bind("peeled", 0, turn == 0 ? buffer.depth : buffer.faces->depth);
  mesh_.draw();
  gl.glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl.glDisable(GL_CULL_FACE);
  gl.glDisable(GL_DEPTH_TEST);
}

}  // namespace nook
