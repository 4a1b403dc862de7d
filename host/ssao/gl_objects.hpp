#pragma once

#include <cstddef>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ssao/gl_context.hpp"

namespace nook {

/// A vertex, index or texel buffer on the GL side, filled once.
class GlBuffer {
 public:
  GlBuffer(const GlContext& context, GLenum target, const void* data, std::size_t bytes);
  ~GlBuffer();
  GlBuffer(const GlBuffer&) = delete;
  GlBuffer& operator=(const GlBuffer&) = delete;
  GLuint id() const { return id_; }

 private:
  const GlContext& context_;
  GLuint id_ = 0;
};

/// A vertex buffer and how it is laid out: attributes 0, 1, ... of floats, one behind another in each vertex.
class GlVertexArray {
 public:
  /// Bound after it. `components`: floats of each attribute.
  GlVertexArray(const GlContext& context, std::span<const float> vertices,
                std::initializer_list<int> components);
  ~GlVertexArray();
  GlVertexArray(const GlVertexArray&) = delete;
  GlVertexArray& operator=(const GlVertexArray&) = delete;
  void bind() const;

 private:
  const GlContext& context_;
  GLuint id_ = 0;
  GlBuffer vertices_;
};

/// A 2D texture without mipmaps, read with texelFetch.
class GlTexture {
 public:
  /// width, height: pixels. format: a sized internal format such as GL_RGBA32F.
  GlTexture(const GlContext& context, GLenum format, int width, int height);
  ~GlTexture();
  GlTexture(const GlTexture&) = delete;
  GlTexture& operator=(const GlTexture&) = delete;
  GLuint id() const { return id_; }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  const GlContext& context_;
  GLuint id_ = 0;
  int width_, height_;
};

/// A framebuffer object; `colors` are its draw buffers 0, 1, ..., `depth` may be null.
class GlFramebuffer {
 public:
  GlFramebuffer(const GlContext& context, std::initializer_list<const GlTexture*> colors,
                const GlTexture* depth);
  ~GlFramebuffer();
  GlFramebuffer(const GlFramebuffer&) = delete;
  GlFramebuffer& operator=(const GlFramebuffer&) = delete;
  /// Binds it for drawing and sets the viewport to all of it.
  void bind() const;
  /// Reads `components` floats a pixel (1: red, 2: RG, 4: RGBA) of draw buffer `color`, rows in window
  /// order.
  std::vector<float> read(int color, int components, int x, int y, int width, int height) const;

 private:
  const GlContext& context_;
  GLuint id_ = 0;
  int width_, height_;
};

/// A linked program from embedded sources ("glsl/quad.vert"), with `#define`s put before them.
class GlProgram {
 public:
  using Defines = std::vector<std::pair<std::string, std::string>>;
  /// `common`: a file put before the fragment shader (functions it shares with others), or empty.
  GlProgram(const GlContext& context, const std::string& vertex, const std::string& fragment,
            const std::string& common, const Defines& defines);
  ~GlProgram();
  GlProgram(const GlProgram&) = delete;
  GlProgram& operator=(const GlProgram&) = delete;

  void use() const;
  // The program must be in use. A name that the shader does not read is ignored, as in OpenGL.
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, int x, int y) const;
  void set(const char* name, float x, float y) const;
  void set(const char* name, float x, float y, float z) const;
  /// Binds `texture` to `unit` and the sampler `name` to that unit.
  void bind(const char* name, int unit, const GlTexture& texture) const;

 private:
  GLint location(const char* name) const;
  const GlContext& context_;
  GLuint id_ = 0;
};

}  // namespace nook
