#include "ssao/geometry_pass.hpp"

#include <array>
#include <unordered_map>

#include "base/error.hpp"

namespace nook {
namespace {

bool has_all_normals(const TriangleMesh& mesh, std::size_t triangle) {
  if (!mesh.has_normals()) return false;
  for (const std::uint32_t index : mesh.triangle_normals[triangle])
    if (index == TriangleMesh::no_normal) return false;
  return true;
}

// One vertex for each pair of position and normal that occurs; interleaved position, normal (zero where there
// is none).
struct WeldedVertices {
  std::vector<float> values;  // 6 each
  std::vector<std::uint32_t> indices;
};

WeldedVertices weld(const TriangleMesh& mesh) {
  WeldedVertices welded;
  welded.indices.reserve(mesh.triangles.size() * 3);
  std::unordered_map<std::uint64_t, std::uint32_t> known;
  known.reserve(mesh.positions.size() * 2);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const bool smooth = has_all_normals(mesh, t);
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t p = mesh.triangles[t][corner];
      const std::uint32_t n = smooth ? mesh.triangle_normals[t][corner] : TriangleMesh::no_normal;
      const auto [entry, is_new] =
          known.try_emplace(std::uint64_t(p) << 32 | n, std::uint32_t(welded.values.size() / 6));
      if (is_new) {
        const vec3 position = mesh.positions[p], normal = smooth ? mesh.normals[n] : vec3(0);
        welded.values.insert(welded.values.end(),
                             {position.x, position.y, position.z, normal.x, normal.y, normal.z});
      }
      welded.indices.push_back(entry->second);
    }
  }
  return welded;
}

// Unit, from the winding. The edges are scaled first: a triangle of size 1e-15 would underflow.
vec3 geometric_normal(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const dvec3 p = mesh.positions[a], u = dvec3(mesh.positions[b]) - p, v = dvec3(mesh.positions[c]) - p;
  const dvec3 n = glm::cross(u, v);
  const double length = glm::length(n);
  return length > 0 ? vec3(n / length) : vec3(0, 0, 1);
}

}  // namespace

GlMesh::GlMesh(const GlContext& context, const TriangleMesh& mesh)
    : context_(context), has_vertex_normals_(mesh.has_normals()) {
  const GlFunctions& gl = context.functions();
  gl.glGenVertexArrays(1, &vertex_array_);
  gl.glBindVertexArray(vertex_array_);
  index_count_ = GLsizei(mesh.triangles.size() * 3);
  gl.glEnableVertexAttribArray(0);
  if (has_vertex_normals_) {
    const WeldedVertices welded = weld(mesh);
    bytes_ = welded.values.size() * sizeof(float) + welded.indices.size() * sizeof(std::uint32_t);
    vertices_ = std::make_unique<GlBuffer>(context, GL_ARRAY_BUFFER, welded.values.data(),
                                           welded.values.size() * sizeof(float));
    const GLsizei stride = 6 * sizeof(float);
    gl.glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, stride, nullptr);
    gl.glEnableVertexAttribArray(1);
    gl.glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, stride,
                             reinterpret_cast<const void*>(3 * sizeof(float)));
    indices_ = std::make_unique<GlBuffer>(context, GL_ELEMENT_ARRAY_BUFFER, welded.indices.data(),
                                          welded.indices.size() * sizeof(std::uint32_t));
  } else {
    bytes_ = mesh.positions.size() * sizeof(vec3) + mesh.triangles.size() * 3 * sizeof(std::uint32_t);
    vertices_ = std::make_unique<GlBuffer>(context, GL_ARRAY_BUFFER, mesh.positions.data(),
                                           mesh.positions.size() * sizeof(vec3));
    gl.glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    indices_ = std::make_unique<GlBuffer>(context, GL_ELEMENT_ARRAY_BUFFER, mesh.triangles.data(),
                                          mesh.triangles.size() * sizeof(mesh.triangles[0]));
  }
  bool some_without = false;
  for (std::size_t t = 0; t < mesh.triangles.size() && !some_without; ++t)
    some_without = !has_all_normals(mesh, t);
  if (some_without) {
    GLint limit = 0;
    gl.glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
    if (mesh.triangles.size() > std::size_t(limit))
      throw Error(ExitCode::device,
                  "SSAO takes at most " + std::to_string(limit) + " triangles without vertex normals");
    std::vector<vec3> normals(mesh.triangles.size());
    for (std::size_t t = 0; t < normals.size(); ++t) normals[t] = geometric_normal(mesh, t);
    bytes_ += normals.size() * sizeof(vec3);
    triangle_normals_ =
        std::make_unique<GlBuffer>(context, GL_TEXTURE_BUFFER, normals.data(), normals.size() * sizeof(vec3));
    gl.glGenTextures(1, &normals_texture_);
    gl.glBindTexture(GL_TEXTURE_BUFFER, normals_texture_);
    gl.glTexBuffer(GL_TEXTURE_BUFFER, GL_RGB32F, triangle_normals_->id());
  }
  context.check("uploading the mesh");
}

GlMesh::~GlMesh() {
  const GlFunctions& gl = context_.functions();
  gl.glDeleteTextures(1, &normals_texture_);
  gl.glDeleteVertexArrays(1, &vertex_array_);
}

void GlMesh::draw() const {
  const GlFunctions& gl = context_.functions();
  gl.glBindVertexArray(vertex_array_);
  gl.glDrawElements(GL_TRIANGLES, index_count_, GL_UNSIGNED_INT, nullptr);
}

void GlMesh::bind_triangle_normals(const GlProgram& program, int unit) const {
  const GlFunctions& gl = context_.functions();
  gl.glActiveTexture(GL_TEXTURE0 + GLenum(unit));
  gl.glBindTexture(GL_TEXTURE_BUFFER, normals_texture_);
  program.set("triangle_normals", unit);
}

GBuffer::GBuffer(const GlContext& context, int width, int height, bool with_position, int layers)
    : surface(context, GL_RGBA32F, width, height),
      normals(context, GL_RGBA32F, width, height),
      depth(context, GL_DEPTH_COMPONENT32F, width, height) {
  if (with_position) {
    position.emplace(context, GL_RGBA32F, width, height);
    front.reset(new GlFramebuffer(context, {&surface, &normals, &*position}, &depth));
  } else {
    front.reset(new GlFramebuffer(context, {&surface, &normals}, &depth));
  }
  if (layers > 2) {
    surface2.emplace(context, GL_RGBA32F, width, height);
    normals2.emplace(context, GL_RGBA32F, width, height);
    second.reset(new GlFramebuffer(context, {&*surface2, &*normals2}, &depth));
  }
}

GeometryPass::GeometryPass(const GlContext& context, const TriangleMesh& mesh)
    : context_(context), mesh_(context, mesh), scale_(mesh.bounds.bounding_radius()), center_(0) {
  if (!mesh.bounds.empty()) center_ = mesh.bounds.center();
}

const GlProgram& GeometryPass::program(Pass pass, bool with_position) {
  std::unique_ptr<GlProgram>& program = programs_[pass == Pass::front && with_position ? 4 : int(pass)];
  if (!program) {
    const bool back = pass == Pass::back || pass == Pass::second_back;
    const bool peel = pass == Pass::second_front || pass == Pass::second_back;
    program = std::make_unique<GlProgram>(
        context_, "glsl/gbuffer.vert", "glsl/gbuffer.frag", "",
        GlProgram::Defines{{"BACK", back ? "1" : "0"},
                           {"PEEL", peel ? "1" : "0"},
                           {"WRITE_POSITION", pass == Pass::front && with_position ? "1" : "0"},
                           {"SOME_WITHOUT_NORMALS", mesh_.some_without_normals() && !back ? "1" : "0"}});
  }
  return *program;
}

void GeometryPass::draw(const SsaoView& view, const GBuffer& buffer, int layers) {
  draw(Pass::front, view, buffer);
  if (layers >= 2) draw(Pass::back, view, buffer);
  if (layers > 2) {
    draw(Pass::second_front, view, buffer);
    draw(Pass::second_back, view, buffer);
  }
}

void GeometryPass::draw(Pass pass, const SsaoView& view, const GBuffer& buffer) {
  const GlFunctions& gl = context_.functions();
  const bool back = pass == Pass::back || pass == Pass::second_back;
  const bool second = pass == Pass::second_front || pass == Pass::second_back;
  (second ? buffer.second : buffer.front)->bind();
  gl.glEnable(GL_DEPTH_TEST);
  gl.glDepthFunc(GL_GREATER);
  // The back layer is drawn into the alpha channel of the front layer's texture, with a depth buffer of its
  // own.
  if (back) {
    gl.glEnable(GL_CULL_FACE);
    gl.glCullFace(GL_FRONT);
    gl.glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_TRUE);
  }
  const float zero[4] = {0, 0, 0, 0};
  // Positions are cleared to a far depth, so that the background is behind everything.
  const float far_position[4] = {0, 0, -1e9f, 0};
  gl.glClearBufferfv(GL_DEPTH, 0, zero);
  if (!back) {
    gl.glClearBufferfv(GL_COLOR, 0, zero);
    gl.glClearBufferfv(GL_COLOR, 1, zero);
    if (buffer.position && !second) gl.glClearBufferfv(GL_COLOR, 2, far_position);
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
  if (second) program.bind("nearer", 0, buffer.surface);
  if (mesh_.some_without_normals() && !back) mesh_.bind_triangle_normals(program, 1);
  mesh_.draw();
  gl.glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl.glDisable(GL_CULL_FACE);
  gl.glDisable(GL_DEPTH_TEST);
}

}  // namespace nook
