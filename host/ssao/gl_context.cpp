#include "ssao/gl_context.hpp"

#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "base/error.hpp"

namespace nook {

void GlContext::load(void* (*address)(const char* name)) {
#define NOOK_GL_LOAD(type, name)                     \
  gl_.name = reinterpret_cast<type>(address(#name)); \
  if (!gl_.name) throw Error(ErrorKind::device, "the OpenGL library lacks " #name);
  NOOK_GL_FUNCTIONS(NOOK_GL_LOAD)
#undef NOOK_GL_LOAD
  renderer_ = reinterpret_cast<const char*>(gl_.glGetString(GL_RENDERER));
  version_ = reinterpret_cast<const char*>(gl_.glGetString(GL_VERSION));
  gl_.glClipControl(GL_UPPER_LEFT, GL_ZERO_TO_ONE);
}

void GlContext::check(const char* doing) const {
  if (gl_.glGetGraphicsResetStatus() != GL_NO_ERROR)
    throw Error(ErrorKind::device, std::string("the OpenGL context was lost while ") + doing);
  if (const GLenum error = gl_.glGetError(); error != GL_NO_ERROR) {
    char code[16];
    std::snprintf(code, sizeof code, "0x%04x", error);
    throw Error(ErrorKind::device, std::string("OpenGL error ") + code + " while " + doing +
                                       (error == GL_OUT_OF_MEMORY ? " (out of memory)" : ""));
  }
}

std::unique_ptr<GlContext> make_gl_context() {
  const char* chosen = std::getenv("NOOK_GL");
  const std::string_view name = chosen ? chosen : "";
  if (name.empty() || name == "osmesa") return make_osmesa_context();
  if (name == "egl") return make_egl_context();
  throw Error(ErrorKind::device, "NOOK_GL is '" + std::string(name) + "'; it must be osmesa or egl");
}

}  // namespace nook
