// SPDX-License-Identifier: MIT
#include "rule/kernels.h"

#include "base/error.h"

namespace tunica {

const Kernels& kernels(InstructionSet set) {
  const bool has_avx2 = __builtin_cpu_supports("avx2") != 0;
  if (set == InstructionSet::avx2 && !has_avx2) fail("this machine has no AVX2");
  const bool use_avx2 = set == InstructionSet::avx2 || (set == InstructionSet::best && has_avx2);
  return use_avx2 ? avx2::kernels() : sse2::kernels();
}

}  // namespace tunica
