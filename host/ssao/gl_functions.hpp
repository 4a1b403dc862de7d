#pragma once

#include <GL/glcorearb.h>

namespace nook {

// Every OpenGL function that nook calls. They are looked up in the loaded library by name: linking libGL
// beside libOSMesa makes calls silently do nothing.
#define NOOK_GL_FUNCTIONS(F)                                     \
  F(PFNGLACTIVETEXTUREPROC, glActiveTexture)                     \
  F(PFNGLATTACHSHADERPROC, glAttachShader)                       \
  F(PFNGLBINDBUFFERPROC, glBindBuffer)                           \
  F(PFNGLBINDFRAMEBUFFERPROC, glBindFramebuffer)                 \
  F(PFNGLBINDTEXTUREPROC, glBindTexture)                         \
  F(PFNGLBINDVERTEXARRAYPROC, glBindVertexArray)                 \
  F(PFNGLBUFFERDATAPROC, glBufferData)                           \
  F(PFNGLCHECKFRAMEBUFFERSTATUSPROC, glCheckFramebufferStatus)   \
  F(PFNGLCLEARBUFFERFVPROC, glClearBufferfv)                     \
  F(PFNGLCLIPCONTROLPROC, glClipControl)                         \
  F(PFNGLCOLORMASKPROC, glColorMask)                             \
  F(PFNGLCOMPILESHADERPROC, glCompileShader)                     \
  F(PFNGLCREATEPROGRAMPROC, glCreateProgram)                     \
  F(PFNGLCREATESHADERPROC, glCreateShader)                       \
  F(PFNGLCULLFACEPROC, glCullFace)                               \
  F(PFNGLDELETEBUFFERSPROC, glDeleteBuffers)                     \
  F(PFNGLDELETEFRAMEBUFFERSPROC, glDeleteFramebuffers)           \
  F(PFNGLDELETEPROGRAMPROC, glDeleteProgram)                     \
  F(PFNGLDELETESHADERPROC, glDeleteShader)                       \
  F(PFNGLDELETETEXTURESPROC, glDeleteTextures)                   \
  F(PFNGLDELETEVERTEXARRAYSPROC, glDeleteVertexArrays)           \
  F(PFNGLDEPTHFUNCPROC, glDepthFunc)                             \
  F(PFNGLDISABLEPROC, glDisable)                                 \
  F(PFNGLDRAWARRAYSPROC, glDrawArrays)                           \
  F(PFNGLDRAWBUFFERSPROC, glDrawBuffers)                         \
  F(PFNGLDRAWELEMENTSPROC, glDrawElements)                       \
  F(PFNGLENABLEPROC, glEnable)                                   \
  F(PFNGLENABLEVERTEXATTRIBARRAYPROC, glEnableVertexAttribArray) \
  F(PFNGLFINISHPROC, glFinish)                                   \
  F(PFNGLFRAMEBUFFERTEXTURE2DPROC, glFramebufferTexture2D)       \
  F(PFNGLGENBUFFERSPROC, glGenBuffers)                           \
  F(PFNGLGENFRAMEBUFFERSPROC, glGenFramebuffers)                 \
  F(PFNGLGENTEXTURESPROC, glGenTextures)                         \
  F(PFNGLGENVERTEXARRAYSPROC, glGenVertexArrays)                 \
  F(PFNGLGETERRORPROC, glGetError)                               \
  F(PFNGLGETGRAPHICSRESETSTATUSPROC, glGetGraphicsResetStatus)   \
  F(PFNGLGETINTEGERVPROC, glGetIntegerv)                         \
  F(PFNGLGETPROGRAMINFOLOGPROC, glGetProgramInfoLog)             \
  F(PFNGLGETPROGRAMIVPROC, glGetProgramiv)                       \
  F(PFNGLGETSHADERINFOLOGPROC, glGetShaderInfoLog)               \
  F(PFNGLGETSHADERIVPROC, glGetShaderiv)                         \
  F(PFNGLGETSTRINGPROC, glGetString)                             \
  F(PFNGLGETUNIFORMLOCATIONPROC, glGetUniformLocation)           \
  F(PFNGLLINKPROGRAMPROC, glLinkProgram)                         \
  F(PFNGLPIXELSTOREIPROC, glPixelStorei)                         \
  F(PFNGLREADBUFFERPROC, glReadBuffer)                           \
  F(PFNGLREADPIXELSPROC, glReadPixels)                           \
  F(PFNGLSHADERSOURCEPROC, glShaderSource)                       \
  F(PFNGLTEXBUFFERPROC, glTexBuffer)                             \
  F(PFNGLTEXPARAMETERIPROC, glTexParameteri)                     \
  F(PFNGLTEXSTORAGE2DPROC, glTexStorage2D)                       \
  F(PFNGLTEXSUBIMAGE2DPROC, glTexSubImage2D)                     \
  F(PFNGLUNIFORM1FPROC, glUniform1f)                             \
  F(PFNGLUNIFORM1IPROC, glUniform1i)                             \
  F(PFNGLUNIFORM2FPROC, glUniform2f)                             \
  F(PFNGLUNIFORM2IPROC, glUniform2i)                             \
  F(PFNGLUNIFORM3FPROC, glUniform3f)                             \
  F(PFNGLUSEPROGRAMPROC, glUseProgram)                           \
  F(PFNGLVERTEXATTRIBPOINTERPROC, glVertexAttribPointer)         \
  F(PFNGLVIEWPORTPROC, glViewport)

/// The loaded functions: `gl.glClear(...)`.
struct GlFunctions {
#define NOOK_GL_MEMBER(type, name) type name = nullptr;
  NOOK_GL_FUNCTIONS(NOOK_GL_MEMBER)
#undef NOOK_GL_MEMBER
};

}  // namespace nook
