// The system's OSMesa with a fault: the context is lost after NOOK_LOSE_CONTEXT questions about it. Loaded by NOOK_OSMESA; what is not
// defined here is found in the library that this one depends on.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <stdlib.h>
#include <string.h>

static unsigned reset_status(void) {
  static long questions = 0;
  const char* most = getenv("NOOK_LOSE_CONTEXT");
  return most && ++questions > atol(most) ? 0x8253 /* GL_GUILTY_CONTEXT_RESET */ : 0;
}

void* OSMesaGetProcAddress(const char* name) {
  static void* (*next)(const char*) = NULL;
  if (!next) next = (void* (*)(const char*))dlsym(RTLD_NEXT, "OSMesaGetProcAddress");
  if (strcmp(name, "glGetGraphicsResetStatus") == 0) return (void*)reset_status;
  return next(name);
}
