#include "support/kernels.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "device/kernel_source.hpp"

namespace nook::test {

Device& device() {
  // Never destroyed: the implementation may have ended before static objects are.
  static Device& chosen = *new Device([] {
    const char* selector = std::getenv("NOOK_TEST_DEVICE");
    return select_device(selector ? selector : "");
  }());
  return chosen;
}

std::string test_kernel_source(const std::string& file) {
  std::string path = std::string(NOOK_SOURCE_DIR) + "/tests/kernels/" + file;
  std::ifstream stream(path);
  if (!stream) throw std::runtime_error("cannot read " + path);
  std::stringstream text;
  text << stream.rdbuf();
  return flatten_kernel("tests/kernels/" + file, text.str());
}

std::string without_avx512(const std::string& source) {
  return "#undef __AVX512F__\n" + source;
}

TestProgram::TestProgram(const std::string& source, const BuildOptions& options)
    : program_(build_program(device(), source, options)) {}

void TestProgram::Call::add_buffer(const void* data, std::size_t bytes) {
  buffers_.push_back(device().buffer(bytes));
  if (bytes)
    check_opencl(opencl().clEnqueueWriteBuffer(device().queue(), buffers_.back().get(), CL_TRUE, 0, bytes,
                                               data, 0, nullptr, nullptr),
                 "clEnqueueWriteBuffer");
  cl_mem memory = buffers_.back().get();
  add_value(&memory, sizeof memory);
}

void TestProgram::Call::add_value(const void* value, std::size_t bytes) {
  check_opencl(opencl().clSetKernelArg(kernel_.get(), index_++, bytes, value), "clSetKernelArg");
}

void TestProgram::Call::launch(std::size_t count) {
  check_opencl(opencl().clEnqueueNDRangeKernel(device().queue(), kernel_.get(), 1, nullptr, &count, nullptr,
                                               0, nullptr, nullptr),
               "clEnqueueNDRangeKernel");
  device().finish();
}

void TestProgram::Call::read_buffer(void* data, std::size_t bytes) {
  cl_mem memory = buffers_[next_++].get();
  if (bytes)
    check_opencl(
        opencl().clEnqueueReadBuffer(device().queue(), memory, CL_TRUE, 0, bytes, data, 0, nullptr, nullptr),
        "clEnqueueReadBuffer");
}

}  // namespace nook::test
