// SPDX-License-Identifier: MIT
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>

namespace tunica {

/// A buffer of doubles, aligned for vectors and padded to whole ones.
class AlignedBuffer {
 public:
  /// New values are zero; old ones are lost.
  void resize(size_t size) {
    const size_t bytes = (size * sizeof(double) + 127) / 64 * 64;
    // Large ones on huge pages where the system gives them: sweeps over them miss fewer address translations.
    const size_t alignment = bytes >= huge_page ? huge_page : 64;
    data_.reset(static_cast<double*>(std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment)));
    if (!data_) throw std::bad_alloc();
    if (alignment == huge_page) madvise(data_.get(), bytes, MADV_HUGEPAGE);
    std::memset(data_.get(), 0, bytes);
    size_ = size;
  }
  double* data() { return data_.get(); }
  const double* data() const { return data_.get(); }
  size_t size() const { return size_; }

 private:
  static constexpr size_t huge_page = size_t{1} << 21;
  struct Free {
    void operator()(double* p) const { std::free(p); }
  };
  std::unique_ptr<double[], Free> data_;
  size_t size_ = 0;
};

}  // namespace tunica
