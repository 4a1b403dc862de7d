#include "ssao/geometry_pass.hpp"

#include <algorithm>
#include <array>
#include <unordered_map>

#include "base/error.hpp"

namespace nook {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Unit, from the winding, in double precision: a triangle of size 1e-15 would underflow.
vec3 geometric_normal(const TriangleMesh& mesh, const Triangle& triangle) {
  const dvec3 p = mesh.positions[triangle[0]];
  const dvec3 n = glm::cross(dvec3(mesh.positions[triangle[1]]) - p, dvec3(mesh.positions[triangle[2]]) - p);
  const double length = glm::length(n);
  return length > 0 ? vec3(n / length) : vec3(0, 0, 1);
}

// Vertices as they are uploaded: position and normal interleaved, 6 floats each.
struct Vertices {
  std::vector<float> values;
  std::vector<Triangle> triangles;

  std::uint32_t add(const vec3& position, const vec3& normal) {
    values.insert(values.end(), {position.x, position.y, position.z, normal.x, normal.y, normal.z});
    return std::uint32_t(values.size() / 6 - 1);
  }
};

// With vertex normals: one vertex for each pair of position and normal that occurs. A triangle that lacks a
// normal at any corner has its geometric normal at all three.
Vertices smooth_vertices(const TriangleMesh& mesh) {
  Vertices vertices;
  vertices.triangles.reserve(mesh.triangles.size());
  std::unordered_map<std::uint64_t, std::uint32_t> known;
  known.reserve(mesh.positions.size() * 2);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle &positions = mesh.triangles[t], &normals = mesh.triangle_normals[t];
    const bool smooth = std::find(normals.begin(), normals.end(), TriangleMesh::no_normal) == normals.end();
    const vec3 geometric = smooth ? vec3(0) : geometric_normal(mesh, positions);
    Triangle& out = vertices.triangles.emplace_back();
    for (int corner = 0; corner < 3; ++corner) {
      const vec3 position = mesh.positions[positions[corner]];
      if (!smooth) {
        out[corner] = vertices.add(position, geometric);
        continue;
      }
      const std::uint64_t key = std::uint64_t(positions[corner]) << 32 | normals[corner];
      const auto [entry, is_new] = known.try_emplace(key, 0);
      if (is_new) entry->second = vertices.add(position, mesh.normals[normals[corner]]);
      out[corner] = entry->second;
    }
  }
  return vertices;
}

// Without vertex normals: a triangle's normal is the flat attribute of its last vertex (OpenGL's provoking
// vertex). Each triangle is turned to end in a vertex that no other triangle ends in; where there is none
// left, the vertex is doubled.
Vertices flat_vertices(const TriangleMesh& mesh) {
  Vertices vertices;
  vertices.triangles = mesh.triangles;
  for (const vec3& position : mesh.positions) vertices.add(position, vec3(0));
  std::vector<bool> taken(mesh.positions.size());
  for (Triangle& triangle : vertices.triangles) {
    const vec3 normal = geometric_normal(mesh, triangle);
    for (int turn = 0; turn < 2 && taken[triangle[2]]; ++turn)
      std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
    std::uint32_t& last = triangle[2];
    if (taken[last]) {
      last = vertices.add(mesh.positions[last], normal);
    } else {
      taken[last] = true;
      for (int axis = 0; axis < 3; ++axis)
        vertices.values[6 * std::size_t(last) + 3 + std::size_t(axis)] = normal[axis];
    }
  }
  return vertices;
}

}  // namespace

GlMesh::GlMesh(const GlContext& context, const TriangleMesh& mesh)
    : context_(context), smooth_(mesh.has_normals()) {
  const GlFunctions& gl = context.functions();
  const Vertices vertices = smooth_ ? smooth_vertices(mesh) : flat_vertices(mesh);
  const std::size_t vertex_bytes = vertices.values.size() * sizeof(float);
  const std::size_t index_bytes = vertices.triangles.size() * sizeof(Triangle);
  bytes_ = vertex_bytes + index_bytes;
  index_count_ = GLsizei(vertices.triangles.size() * 3);
  gl.glGenVertexArrays(1, &vertex_array_);
  gl.glBindVertexArray(vertex_array_);
  vertices_ = std::make_unique<GlBuffer>(context, GL_ARRAY_BUFFER, vertices.values.data(), vertex_bytes);
  const GLsizei stride = 6 * sizeof(float);
  gl.glEnableVertexAttribArray(0);
  gl.glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, stride, nullptr);
  gl.glEnableVertexAttribArray(1);
  gl.glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, stride,
                           reinterpret_cast<const void*>(3 * sizeof(float)));
  indices_ =
      std::make_unique<GlBuffer>(context, GL_ELEMENT_ARRAY_BUFFER, vertices.triangles.data(), index_bytes);
  context.check("uploading the mesh");
}

GlMesh::~GlMesh() {
  const GlFunctions& gl = context_.functions();
  gl.glDeleteVertexArrays(1, &vertex_array_);
}

void GlMesh::draw() const {
  const GlFunctions& gl = context_.functions();
  gl.glBindVertexArray(vertex_array_);
  gl.glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
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
