// SPDX-License-Identifier: MIT
#define TUNICA_ISA avx2
#include "field/pair_kernels.inl"
