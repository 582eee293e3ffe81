// SPDX-License-Identifier: MIT
#define TUNICA_ISA sse2
#include "field/pair_kernels.inl"
