#include <dlfcn.h>

#include <array>
#include <cstdlib>
#include <string_view>

#include "base/error.hpp"
#include "ssao/gl_context.hpp"

namespace nook {
namespace {

// The part of GL/osmesa.h that is used. That header includes GL/gl.h, which cannot stand beside
// GL/glcorearb.h.
using OsMesaContext = struct OsMesaContextRecord*;
using OsMesaCreate = OsMesaContext (*)(const int* attributes, OsMesaContext shared);
using OsMesaDestroy = void (*)(OsMesaContext);
using OsMesaMakeCurrent = GLboolean (*)(OsMesaContext, void* buffer, GLenum type, GLsizei width,
                                        GLsizei height);
using OsMesaGetProcAddress = void* (*)(const char* name);
constexpr int osmesa_format = 0x22, osmesa_profile = 0x33, osmesa_core_profile = 0x34, osmesa_major = 0x36,
              osmesa_minor = 0x37;

OsMesaGetProcAddress osmesa_address = nullptr;

// Never unmapped: LLVM, which Mesa brings, has destructors that must still find their code at exit.
void* open_library() {
  if (const char* name = std::getenv("NOOK_OSMESA"); name && *name) {
    if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return library;
    throw Error(ErrorKind::device,
                "cannot load '" + std::string(name) + "' (NOOK_OSMESA), which SSAO draws with");
  }
  for (const char* name : {"libOSMesa.so.8", "libOSMesa.so.6"})
    if (void* library = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return library;
  throw Error(ErrorKind::device,
              "SSAO needs libOSMesa.so.8, which is not installed (Debian: apt install libosmesa6)");
}

template <typename Function>
Function find(void* library, const char* name) {
  if (void* address = dlsym(library, name)) return reinterpret_cast<Function>(address);
  throw Error(ErrorKind::device, "the OSMesa library lacks " + std::string(name));
}

// An unknown name makes Mesa 22.3 crash.
void check_driver_choice() {
  const char* driver = std::getenv("GALLIUM_DRIVER");
  if (!driver || !*driver) return;
  const std::string_view name = driver;
  if (name != "llvmpipe" && name != "softpipe")
    throw Error(ErrorKind::device, "GALLIUM_DRIVER is '" + std::string(name) +
                                       "', which OSMesa does not know (llvmpipe is its default)");
}

class OsMesa final : public GlContext {
 public:
  OsMesa() {
    check_driver_choice();
    void* library = open_library();
    const auto create = find<OsMesaCreate>(library, "OSMesaCreateContextAttribs");
    destroy_ = find<OsMesaDestroy>(library, "OSMesaDestroyContext");
    make_current_ = find<OsMesaMakeCurrent>(library, "OSMesaMakeCurrent");
    osmesa_address = find<OsMesaGetProcAddress>(library, "OSMesaGetProcAddress");
    const int attributes[] = {
        osmesa_format, GL_RGBA, osmesa_profile, osmesa_core_profile, osmesa_major, 4, osmesa_minor, 5, 0};
    context_ = create(attributes, nullptr);
    if (!context_)
      throw Error(ErrorKind::device, "OSMesa cannot make an OpenGL 4.5 core context, which SSAO needs");
    try {
      make_current();
      load([](const char* name) { return osmesa_address(name); });
    } catch (...) {
      destroy_(context_);
      throw;
    }
  }
  ~OsMesa() override { destroy_(context_); }

  void make_current() override {
    if (!make_current_(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1))
      throw Error(ErrorKind::device, "OSMesa cannot make its context current");
  }

 private:
  OsMesaDestroy destroy_ = nullptr;
  OsMesaMakeCurrent make_current_ = nullptr;
  OsMesaContext context_ = nullptr;
  std::array<unsigned char, 4> pixel_{};  // the default framebuffer; all drawing goes to framebuffer objects
};

}  // namespace

std::unique_ptr<GlContext> make_osmesa_context() {
  return std::make_unique<OsMesa>();
}

}  // namespace nook
