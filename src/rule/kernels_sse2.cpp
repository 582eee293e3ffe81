// SPDX-License-Identifier: MIT
#define TUNICA_ISA sse2
#define TUNICA_ISA_NAME "sse2"
#define TUNICA_VECTOR_BYTES 16
#include "rule/kernels.inl"
