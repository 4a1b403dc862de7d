#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace nook {

/// Allocates large arrays on boundaries of, and if the system likes in, large pages: fewer page faults while
/// the array is written for the first time. Elements without an initial value are left as the memory is:
/// resize() writes nothing, so that threads may be the first to write their parts.
template <class T>
struct LargeAllocator {
  using value_type = T;
  static constexpr std::size_t page = std::size_t(1) << 21;  // bytes

  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>&) {}

  T* allocate(std::size_t count) {
    if (count > std::size_t(-1) / sizeof(T)) throw std::bad_array_new_length();
    const std::size_t bytes = count * sizeof(T);
    if (bytes < 2 * page) return static_cast<T*>(::operator new(bytes, small));
    void* memory = ::operator new(bytes, large);
#ifdef MADV_HUGEPAGE
    madvise(memory, bytes, MADV_HUGEPAGE);
#endif
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t count) {
    ::operator delete(memory, count * sizeof(T) < 2 * page ? small : large);
  }
  template <class U>
  void construct(U* place) {
    ::new (static_cast<void*>(place)) U;
  }
  template <class U, class... Args>
  void construct(U* place, Args&&... args) {
    ::new (static_cast<void*>(place)) U(std::forward<Args>(args)...);
  }
  friend bool operator==(const LargeAllocator&, const LargeAllocator&) {
    return true;
  }

 private:
  static constexpr std::align_val_t small{alignof(T) < 64 ? 64 : alignof(T)}, large{page};
};

template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

}  // namespace nook
