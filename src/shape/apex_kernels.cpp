// SPDX-License-Identifier: MIT
#include "shape/apex_kernels.h"

namespace tunica {

const ApexKernels& apex_kernels() {
  static const ApexKernels& set = __builtin_cpu_supports("avx2") != 0 ? avx2::apex_kernels() : sse2::apex_kernels();
  return set;
}

}  // namespace tunica
