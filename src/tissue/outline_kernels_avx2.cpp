// SPDX-License-Identifier: MIT
#define TUNICA_ISA avx2
#include "tissue/outline_kernels.inl"
