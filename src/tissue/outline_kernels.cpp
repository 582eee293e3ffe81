// SPDX-License-Identifier: MIT
#include "tissue/outline_kernels.h"

namespace tunica {

const OutlineKernels& outline_kernels() {
  static const OutlineKernels& set =
      __builtin_cpu_supports("avx2") != 0 ? avx2::outline_kernels() : sse2::outline_kernels();
  return set;
}

}  // namespace tunica
