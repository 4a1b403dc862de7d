#include "ssao/gl_objects.hpp"

#include <numeric>
#include <string_view>

#include "base/embedded_file.hpp"
#include "base/error.hpp"

namespace nook {
namespace glsl {
extern const EmbeddedFile files[];
extern const unsigned file_count;
}  // namespace glsl

namespace {

const char* shader_text(std::string_view path) {
  for (unsigned i = 0; i < glsl::file_count; ++i)
    if (path == glsl::files[i].path) return glsl::files[i].text;
  throw Error(ErrorKind::internal, "no embedded shader '" + std::string(path) + "'");
}

// Compiles version + defines + common + text. The log numbers `text` as source 1, `common` as source 2.
GLuint compile(const GlContext& context, GLenum stage, const std::string& path, const std::string& common,
               const GlProgram::Defines& defines) {
  const GlFunctions& gl = context.functions();
  std::string head = "#version 450 core\n";
  for (const auto& [name, value] : defines) head += "#define " + name + " " + value + "\n";
  if (!common.empty()) head += "#line 1 2\n" + std::string(shader_text(common));
  head += "#line 1 1\n";
  const char* parts[] = {head.c_str(), shader_text(path)};
  const GLuint shader = gl.glCreateShader(stage);
  gl.glShaderSource(shader, 2, parts, nullptr);
  gl.glCompileShader(shader);
  GLint ok = GL_FALSE;
  gl.glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
  if (ok) return shader;
  char log[2000] = "";
  gl.glGetShaderInfoLog(shader, sizeof log, nullptr, log);
  gl.glDeleteShader(shader);
  throw Error(ErrorKind::device, path + " does not compile: " + log);
}

}  // namespace

GlBuffer::GlBuffer(const GlContext& context, GLenum target, const void* data, std::size_t bytes)
    : context_(context) {
  const GlFunctions& gl = context.functions();
  gl.glGenBuffers(1, &id_);
  gl.glBindBuffer(target, id_);
  gl.glBufferData(target, GLsizeiptr(bytes), data, GL_STATIC_DRAW);
}

GlBuffer::~GlBuffer() {
  context_.functions().glDeleteBuffers(1, &id_);
}

GlVertexArray::GlVertexArray(const GlContext& context, std::span<const float> vertices,
                             std::initializer_list<int> components)
    : context_(context),
      id_([&] {
        GLuint id = 0;
        context.functions().glGenVertexArrays(1, &id);
        context.functions().glBindVertexArray(id);
        return id;
      }()),
      vertices_(context, GL_ARRAY_BUFFER, vertices.data(), vertices.size_bytes()) {
  const GlFunctions& gl = context.functions();
  const int floats = std::accumulate(components.begin(), components.end(), 0);
  GLuint attribute = 0;
  std::size_t before = 0;
  for (const int count : components) {
    gl.glEnableVertexAttribArray(attribute);
    gl.glVertexAttribPointer(attribute++, count, GL_FLOAT, GL_FALSE, GLsizei(floats * sizeof(float)),
                             reinterpret_cast<const void*>(before));
    before += std::size_t(count) * sizeof(float);
  }
}

GlVertexArray::~GlVertexArray() {
  context_.functions().glDeleteVertexArrays(1, &id_);
}

void GlVertexArray::bind() const {
  context_.functions().glBindVertexArray(id_);
}

GlTexture::GlTexture(const GlContext& context, GLenum format, int width, int height)
    : context_(context), width_(width), height_(height) {
  const GlFunctions& gl = context.functions();
  gl.glGenTextures(1, &id_);
  gl.glBindTexture(GL_TEXTURE_2D, id_);
  gl.glTexStorage2D(GL_TEXTURE_2D, 1, format, width, height);
  gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  context.check("making a texture");
}

GlTexture::~GlTexture() {
  context_.functions().glDeleteTextures(1, &id_);
}

GlFramebuffer::GlFramebuffer(const GlContext& context, std::initializer_list<const GlTexture*> colors,
                             const GlTexture* depth)
    : context_(context), width_((*colors.begin())->width()), height_((*colors.begin())->height()) {
  const GlFunctions& gl = context.functions();
  gl.glGenFramebuffers(1, &id_);
  gl.glBindFramebuffer(GL_FRAMEBUFFER, id_);
  std::vector<GLenum> buffers;
  for (const GlTexture* color : colors) {
    const GLenum attachment = GL_COLOR_ATTACHMENT0 + GLenum(buffers.size());
    gl.glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, color->id(), 0);
    buffers.push_back(attachment);
  }
  if (depth) gl.glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth->id(), 0);
  gl.glDrawBuffers(GLsizei(buffers.size()), buffers.data());
  if (gl.glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw Error(ErrorKind::device, "OpenGL cannot draw to floating-point textures of " +
                                       std::to_string(width_) + "x" + std::to_string(height_) + " pixels");
}

GlFramebuffer::~GlFramebuffer() {
  context_.functions().glDeleteFramebuffers(1, &id_);
}

void GlFramebuffer::bind() const {
  const GlFunctions& gl = context_.functions();
  gl.glBindFramebuffer(GL_FRAMEBUFFER, id_);
  gl.glViewport(0, 0, width_, height_);
}

std::vector<float> GlFramebuffer::read(int color, int components, int x, int y, int width, int height) const {
  const GlFunctions& gl = context_.functions();
  const GLenum format = components == 1 ? GL_RED : components == 2 ? GL_RG : GL_RGBA;
  std::vector<float> values(std::size_t(width) * std::size_t(height) * std::size_t(components));
  gl.glBindFramebuffer(GL_FRAMEBUFFER, id_);
  gl.glReadBuffer(GL_COLOR_ATTACHMENT0 + GLenum(color));
  gl.glPixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.glReadPixels(x, y, width, height, format, GL_FLOAT, values.data());
  context_.check("reading pixels");
  return values;
}

GlProgram::GlProgram(const GlContext& context, const std::string& vertex, const std::string& fragment,
                     const std::string& common, const Defines& defines)
    : context_(context) {
  const GlFunctions& gl = context.functions();
  const GLuint vertex_shader = compile(context, GL_VERTEX_SHADER, vertex, "", defines);
  GLuint fragment_shader = 0;
  try {
    fragment_shader = compile(context, GL_FRAGMENT_SHADER, fragment, common, defines);
  } catch (...) {
    gl.glDeleteShader(vertex_shader);
    throw;
  }
  id_ = gl.glCreateProgram();
  gl.glAttachShader(id_, vertex_shader);
  gl.glAttachShader(id_, fragment_shader);
  gl.glLinkProgram(id_);
  gl.glDeleteShader(vertex_shader);
  gl.glDeleteShader(fragment_shader);
  GLint ok = GL_FALSE;
  gl.glGetProgramiv(id_, GL_LINK_STATUS, &ok);
  if (ok) return;
  char log[2000] = "";
  gl.glGetProgramInfoLog(id_, sizeof log, nullptr, log);
  gl.glDeleteProgram(id_);
  throw Error(ErrorKind::device, vertex + " and " + fragment + " do not link: " + log);
}

GlProgram::~GlProgram() {
  context_.functions().glDeleteProgram(id_);
}

GLint GlProgram::location(const char* name) const {
  return context_.functions().glGetUniformLocation(id_, name);
}
void GlProgram::use() const {
  context_.functions().glUseProgram(id_);
}
void GlProgram::set(const char* name, int value) const {
  context_.functions().glUniform1i(location(name), value);
}
void GlProgram::set(const char* name, float value) const {
  context_.functions().glUniform1f(location(name), value);
}
void GlProgram::set(const char* name, int x, int y) const {
  context_.functions().glUniform2i(location(name), x, y);
}
void GlProgram::set(const char* name, float x, float y) const {
  context_.functions().glUniform2f(location(name), x, y);
}
void GlProgram::set(const char* name, float x, float y, float z) const {
  context_.functions().glUniform3f(location(name), x, y, z);
}

void GlProgram::bind(const char* name, int unit, const GlTexture& texture) const {
  const GlFunctions& gl = context_.functions();
  gl.glActiveTexture(GL_TEXTURE0 + GLenum(unit));
  gl.glBindTexture(GL_TEXTURE_2D, texture.id());
  gl.glUniform1i(location(name), unit);
}

}  // namespace nook
