// SPDX-License-Identifier: MIT
#define TUNICA_ISA sse2
#include "tissue/outline_kernels.inl"
