// SPDX-License-Identifier: MIT
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace tunica {

inline constexpr size_t huge_page = size_t{1} << 21;

/// Memory aligned for vectors. Large pieces are put on huge pages where the system gives them: sweeps over them miss
/// fewer address translations, and the first touch costs less. Errors: std::bad_alloc.
inline void* allocate_aligned(size_t bytes) {
  const size_t alignment = bytes >= huge_page ? huge_page : 64;
  void* memory = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
  if (!memory) throw std::bad_alloc();
  if (alignment == huge_page) madvise(memory, bytes, MADV_HUGEPAGE);
  return memory;
}

/// For vectors that are filled by their owner: elements of a resize are not set.
template <class T>
struct LargeAllocator {
  using value_type = T;
  LargeAllocator() = default;
  template <class U>
  LargeAllocator(const LargeAllocator<U>&) {}
  T* allocate(size_t n) { return static_cast<T*>(allocate_aligned(n * sizeof(T) + 1)); }
  void deallocate(T* p, size_t) { std::free(p); }
  template <class U, class... Arguments>
  void construct(U* p, Arguments&&... arguments) {
    if constexpr (sizeof...(Arguments) == 0)
      ::new (static_cast<void*>(p)) U;
    else
      ::new (static_cast<void*>(p)) U{std::forward<Arguments>(arguments)...};
  }
  friend bool operator==(const LargeAllocator&, const LargeAllocator&) { return true; }
};
template <class T>
using LargeVector = std::vector<T, LargeAllocator<T>>;

/// A buffer of doubles, aligned for vectors and padded to whole ones.
class AlignedBuffer {
 public:
  /// New values are zero; old ones are lost.
  void resize(size_t size) {
    const size_t bytes = (size * sizeof(double) + 127) / 64 * 64;
    data_.reset(static_cast<double*>(allocate_aligned(bytes)));
    std::memset(data_.get(), 0, bytes);
    size_ = size;
  }
  double* data() { return data_.get(); }
  const double* data() const { return data_.get(); }
  size_t size() const { return size_; }

 private:
  struct Free {
    void operator()(double* p) const { std::free(p); }
  };
  std::unique_ptr<double[], Free> data_;
  size_t size_ = 0;
};

}  // namespace tunica
