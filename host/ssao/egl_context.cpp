#include <dlfcn.h>

#include <cstdint>
#include <cstdio>
#include <string>

#include "base/error.hpp"
#include "ssao/gl_context.hpp"

namespace nook {
namespace {

// The part of EGL/egl.h and EGL/eglext.h that is used (EGL 1.5, EGL_EXT_platform_base,
// EGL_MESA_platform_surfaceless, EGL_KHR_no_config_context, EGL_KHR_surfaceless_context).
using EglHandle = void*;
using EglGetProcAddress = void* (*)(const char* name);
using EglGetPlatformDisplay = EglHandle (*)(unsigned platform, void* native, const std::int32_t* attributes);
using EglInitialize = unsigned (*)(EglHandle display, std::int32_t* major, std::int32_t* minor);
using EglBindApi = unsigned (*)(unsigned api);
using EglCreateContext = EglHandle (*)(EglHandle display, EglHandle config, EglHandle shared,
                                       const std::int32_t* attributes);
using EglDestroyContext = unsigned (*)(EglHandle display, EglHandle context);
using EglMakeCurrent = unsigned (*)(EglHandle display, EglHandle draw, EglHandle read, EglHandle context);
using EglGetError = std::int32_t (*)();
constexpr unsigned egl_surfaceless_mesa = 0x31DD, egl_opengl_api = 0x30A2;
constexpr std::int32_t egl_major = 0x3098, egl_minor = 0x30FB, egl_profile = 0x30FD, egl_core_profile = 1,
                       egl_none = 0x3038;

class Egl final : public GlContext {
 public:
  Egl() {
    // Never unmapped, as OSMesa is not.
    library_ = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    if (!library_)
      throw Error(ErrorKind::device,
                  "NOOK_GL=egl needs libEGL.so.1, which is not installed (Debian: apt install libegl1)");
    find(get_address_, "eglGetProcAddress");
    EglInitialize initialize;
    EglBindApi bind_api;
    EglCreateContext create;
    find(initialize, "eglInitialize");
    find(bind_api, "eglBindAPI");
    find(create, "eglCreateContext");
    find(destroy_, "eglDestroyContext");
    find(make_current_, "eglMakeCurrent");
    find(error_, "eglGetError");
    const auto display_of = reinterpret_cast<EglGetPlatformDisplay>(get_address_("eglGetPlatformDisplayEXT"));
    if (!display_of) fail("has no platforms (EGL_EXT_platform_base)");
    display_ = display_of(egl_surfaceless_mesa, nullptr, nullptr);
    if (!display_) fail("cannot draw without a display (EGL_MESA_platform_surfaceless)");
    if (!initialize(display_, nullptr, nullptr) || !bind_api(egl_opengl_api)) fail("cannot be started");
    const std::int32_t attributes[] = {egl_major, 4, egl_minor, 5, egl_profile, egl_core_profile, egl_none};
    context_ = create(display_, nullptr, nullptr, attributes);
    if (!context_) fail("cannot make an OpenGL 4.5 core context, which SSAO needs");
    try {
      make_current();
      load(get_address_);
    } catch (...) {
      release();
      throw;
    }
  }
  ~Egl() override { release(); }

  void make_current() override {
    if (!make_current_(display_, nullptr, nullptr, context_)) fail("cannot make its context current");
  }

 private:
  template <typename Function>
  void find(Function& function, const char* name) {
    function = reinterpret_cast<Function>(dlsym(library_, name));
    if (!function) throw Error(ErrorKind::device, "the EGL library lacks " + std::string(name));
  }

  [[noreturn]] void fail(const char* what) const {
    char code[16];
    std::snprintf(code, sizeof code, "0x%04x", unsigned(error_()));
    throw Error(ErrorKind::device, "EGL " + std::string(what) + ": EGL error " + code);
  }

  // The display stays: it is the process's, and another context may draw with it.
  void release() {
    make_current_(display_, nullptr, nullptr, nullptr);
    destroy_(display_, context_);
  }

  void* library_ = nullptr;
  EglGetProcAddress get_address_ = nullptr;
  EglDestroyContext destroy_ = nullptr;
  EglMakeCurrent make_current_ = nullptr;
  EglGetError error_ = nullptr;
  EglHandle display_ = nullptr, context_ = nullptr;
};

}  // namespace

std::unique_ptr<GlContext> make_egl_context() {
  return std::make_unique<Egl>();
}

}  // namespace nook
