#pragma once

#include <string>
#include <vector>

#include "device/program_cache.hpp"

namespace nook::test {

/// The device that tests run on: NOOK_TEST_DEVICE, else the first CPU. One per process.
Device& device();

/// A test kernel, tests/kernels/FILE, with the product's files that it includes put in their place.
std::string test_kernel_source(const std::string& file);

/// The source as a device without AVX-512 compiles it.
std::string without_avx512(const std::string& source);

/// A buffer argument: read by the kernel before it runs, and back into the vector after.
template <class T>
struct InOut {
  std::vector<T>& values;
};

/// A built program whose kernels are run one at a time, over [0, count).
class TestProgram {
 public:
  TestProgram(const std::string& source, const BuildOptions& options);

  /// Arguments in the kernel's order: const std::vector<T>& is read, InOut<T> is read and written, the rest
  /// is passed by value.
  template <class... Arguments>
  void run(const char* kernel_name, std::size_t count, const Arguments&... arguments) const {
    Call call(program_.kernel(kernel_name));
    (call.add(arguments), ...);
    call.launch(count);
    (call.collect(arguments), ...);
  }

 private:
  class Call {
   public:
    explicit Call(ClKernel kernel) : kernel_(std::move(kernel)) {}
    template <class T>
    void add(const std::vector<T>& in) {
      add_buffer(in.data(), in.size() * sizeof(T));
    }
    template <class T>
    void add(const InOut<T>& both) {
      add_buffer(both.values.data(), both.values.size() * sizeof(T));
    }
    template <class T>
    void add(const T& value) {
      add_value(&value, sizeof value);
    }
    void launch(std::size_t count);
    template <class T>
    void collect(const InOut<T>& both) {
      read_buffer(both.values.data(), both.values.size() * sizeof(T));
    }
    template <class T>
    void collect(const std::vector<T>&) {
      ++next_;
    }
    template <class T>
    void collect(const T&) {}

   private:
    void add_buffer(const void* data, std::size_t bytes);
    void add_value(const void* value, std::size_t bytes);
    void read_buffer(void* data, std::size_t bytes);

    ClKernel kernel_;
    unsigned index_ = 0;
    std::vector<ClBuffer> buffers_;
    std::size_t next_ = 0;
  };

  BuiltProgram program_;
};

}  // namespace nook::test
