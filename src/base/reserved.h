// SPDX-License-Identifier: MIT
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <type_traits>
#include <utility>

#include "base/error.h"

namespace tunica {

/// A growable array whose address never changes: address space is reserved at once, pages are used as they are written.
/// Elements are zero until written. Copying copies the used part.
template <class T>
class ReservedArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  static constexpr size_t capacity = size_t{1} << 24;  ///< elements; also the largest tissue

  ReservedArray() {
    void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) fail("out of address space: cannot reserve {} MiB for a column", bytes >> 20);
    data_ = static_cast<T*>(memory);
  }
  ReservedArray(const ReservedArray& other) : ReservedArray() { *this = other; }
  ReservedArray(ReservedArray&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
  ReservedArray& operator=(const ReservedArray& other) {
    if (this == &other) return *this;
    resize(other.size_);
    for (size_t i = 0; i < size_; ++i) data_[i] = other.data_[i];
    return *this;
  }
  ReservedArray& operator=(ReservedArray&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~ReservedArray() {
    if (data_) munmap(data_, bytes);
  }

  size_t size() const { return size_; }
  T* data() { return data_; }
  const T* data() const { return data_; }
  T& operator[](size_t i) { return data_[i]; }
  const T& operator[](size_t i) const { return data_[i]; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }

  /// Grows (new elements zero) or shrinks. Errors: more than `capacity` elements.
  void resize(size_t size) {
    if (size > capacity) fail("a tissue is limited to {} elements of a kind", capacity);
    for (size_t i = size; i < size_; ++i) data_[i] = T{};
    size_ = size;
  }
  void push_back(const T& value) {
    if (size_ >= capacity) fail("a tissue is limited to {} elements of a kind", capacity);
    data_[size_++] = value;
  }
  void pop_back() { data_[--size_] = T{}; }

 private:
  /// A page of slack, so that vector code may read and write whole vectors past the end.
  static constexpr size_t bytes = capacity * sizeof(T) + 8192;
  T* data_ = nullptr;
  size_t size_ = 0;
};

}  // namespace tunica
