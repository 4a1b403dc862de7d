// The system's OpenCL library with faults: NOOK_FAIL_LAUNCH=n makes the n-th kernel launch fail and all later ones (a
// lost device), NOOK_FAULT_LAUNCH=n makes a thread beside it read address 0 (a fault in a driver's thread), NOOK_FAIL_ALLOCATION=bytes makes larger buffers fail. Loaded by NOOK_OPENCL; what is not defined here is found in
// the library that this one depends on.
#define _GNU_SOURCE
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>
#include <pthread.h>
#include <stdlib.h>

static unsigned long long number(const char* name, unsigned long long otherwise) {
  const char* text = getenv(name);
  return text ? strtoull(text, NULL, 10) : otherwise;
}

static void* read_nothing(void* nothing) {
  (void)*(volatile char*)nothing;
  return NULL;
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t* offset,
                              const size_t* global, const size_t* local, cl_uint waits, const cl_event* wait_list,
                              cl_event* event) {
  static unsigned long long launches = 0;
  static __typeof__(&clEnqueueNDRangeKernel) next = NULL;
  if (!next) next = (__typeof__(next))dlsym(RTLD_NEXT, "clEnqueueNDRangeKernel");
  if (++launches >= number("NOOK_FAIL_LAUNCH", ~0ull)) return CL_OUT_OF_RESOURCES;
  if (launches == number("NOOK_FAULT_LAUNCH", ~0ull)) {
    pthread_t thread;
    pthread_create(&thread, NULL, read_nothing, NULL);
    pthread_join(thread, NULL);
  }
  return next(queue, kernel, dimensions, offset, global, local, waits, wait_list, event);
}

cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, size_t bytes, void* data, cl_int* code) {
  static __typeof__(&clCreateBuffer) next = NULL;
  if (!next) next = (__typeof__(next))dlsym(RTLD_NEXT, "clCreateBuffer");
  if (bytes > number("NOOK_FAIL_ALLOCATION", ~0ull)) {
    *code = CL_MEM_OBJECT_ALLOCATION_FAILURE;
    return NULL;
  }
  return next(context, flags, bytes, data, code);
}
