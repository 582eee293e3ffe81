// SPDX-License-Identifier: MIT
#include "field/pair_kernels.h"

namespace tunica {

const PairKernels& pair_kernels() {
  return __builtin_cpu_supports("avx2") != 0 ? avx2::pair_kernels() : sse2::pair_kernels();
}

}  // namespace tunica
