// SPDX-License-Identifier: MIT
#define TUNICA_ISA sse2
#include "shape/apex_kernels.inl"
