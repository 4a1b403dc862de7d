#pragma once

#include <memory>
#include <string>

#include "ssao/gl_functions.hpp"

namespace nook {

/// An OpenGL 4.5 core context without a window: what the SSAO passes draw with.
///
/// The library is mapped when the first context is made and not before: a process that renders no SSAO holds
/// no GL. Window rows run downwards (row 0 is the top) and clip-space depth is in [0, 1]. A context belongs
/// to the thread that last called make_current().
class GlContext {
 public:
  virtual ~GlContext() = default;
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  virtual void make_current() = 0;

  const GlFunctions& functions() const { return gl_; }
  const std::string& renderer() const {
    return renderer_;
  }  ///< GL_RENDERER, e.g. "llvmpipe (LLVM 15.0.6, 256 bits)"
  const std::string& version() const { return version_; }  ///< GL_VERSION

  /// Throws Error(device) with one line if OpenGL reports an error or has lost the context; `doing` names the
  /// work.
  void check(const char* doing) const;

 protected:
  GlContext() = default;
  /// Looks every function up with `address` (name -> function), reads the strings and sets the conventions.
  /// The context must be current.
  void load(void* (*address)(const char* name));

 private:
  GlFunctions gl_;
  std::string renderer_, version_;
};

/// Makes a context with OSMesa (Mesa's off-screen software renderer) and makes it current.
/// The library is $NOOK_OSMESA if set, else libOSMesa.so.8 or .6. Throws Error(device) with one line.
std::unique_ptr<GlContext> make_osmesa_context();

/// Makes a context with surfaceless EGL (EGL_MESA_platform_surfaceless), without window or display, and makes
/// it current: on a GPU if there is one that the system's EGL can draw with, else by software. The library is
/// libEGL.so.1. Throws Error(device) with one line.
std::unique_ptr<GlContext> make_egl_context();

/// One of the two, by $NOOK_GL: osmesa, which is the default, or egl. Throws Error(device) with one line.
std::unique_ptr<GlContext> make_gl_context();

}  // namespace nook
