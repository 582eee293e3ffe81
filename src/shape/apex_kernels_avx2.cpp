// SPDX-License-Identifier: MIT
#define TUNICA_ISA avx2
#include "shape/apex_kernels.inl"
