// SPDX-License-Identifier: MIT
#define TUNICA_ISA avx2
#define TUNICA_ISA_NAME "avx2"
#define TUNICA_VECTOR_BYTES 32
#include "rule/kernels.inl"
