// SPDX-License-Identifier: MIT
// Four numbers side by side. Included by sources that are compiled once per instruction set, within their namespace:
// nothing here may be linked in for another. Each operation rounds as that of one number does.

#pragma once

namespace tunica::TUNICA_ISA {
namespace {

typedef double Four __attribute__((vector_size(32)));
typedef double FourAnywhere __attribute__((vector_size(32), may_alias, aligned(8)));
typedef long Mask __attribute__((vector_size(32)));  // as comparisons give
typedef int Steps __attribute__((vector_size(16)));
typedef int FourSteps __attribute__((vector_size(16), may_alias, aligned(4)));

inline Four all(double x) { return Four{x, x, x, x}; }
inline Four load(const double* p) { return *reinterpret_cast<const FourAnywhere*>(p); }
inline void store(double* p, Four v) { *reinterpret_cast<FourAnywhere*>(p) = v; }
inline Four choose(Mask mask, Four yes, Four no) { return (Four)(((Mask)yes & mask) | ((Mask)no & ~mask)); }
inline Four magnitude(Four x) { return (Four)((Mask)x & (Mask{} + 0x7fffffffffffffffL)); }
inline Four greater(Four a, Four b) { return choose(a > b, a, b); }  // b where one is no number
/// `left` of the four (by the element, which would be read again as a whole only after a wait, where fewer).
inline void store(double* p, long left, Four v) {
  if (left >= 4) return store(p, v);
  for (long k = 0; k < left; ++k) p[k] = v[k];
}
/// One bit for each of the four.
inline int bits_of(Mask mask) {
#if defined(__AVX__)
  return __builtin_ia32_movmskpd256((Four)mask);
#else
  return (mask[0] ? 1 : 0) | (mask[1] ? 2 : 0) | (mask[2] ? 4 : 0) | (mask[3] ? 8 : 0);
#endif
}
inline bool none_of(Mask mask) { return bits_of(mask) == 0; }

inline Four root(Four x) {
#if defined(__AVX__)
  return __builtin_ia32_sqrtpd256(x);
#elif defined(__SSE2__)
  typedef double Two __attribute__((vector_size(16)));
  const Two low = __builtin_ia32_sqrtpd(Two{x[0], x[1]}), high = __builtin_ia32_sqrtpd(Two{x[2], x[3]});
  return Four{low[0], low[1], high[0], high[1]};
#else
  for (int i = 0; i < 4; ++i) x[i] = __builtin_sqrt(x[i]);
  return x;
#endif
}

/// Four rows of four numbers: the first of each, the second of each, ...
inline void transpose(Four& a, Four& b, Four& c, Four& d) {
  const Four ab = __builtin_shuffle(a, b, Mask{0, 4, 2, 6}), ba = __builtin_shuffle(a, b, Mask{1, 5, 3, 7});
  const Four cd = __builtin_shuffle(c, d, Mask{0, 4, 2, 6}), dc = __builtin_shuffle(c, d, Mask{1, 5, 3, 7});
  a = __builtin_shuffle(ab, cd, Mask{0, 1, 4, 5});
  b = __builtin_shuffle(ba, dc, Mask{0, 1, 4, 5});
  c = __builtin_shuffle(ab, cd, Mask{2, 3, 6, 7});
  d = __builtin_shuffle(ba, dc, Mask{2, 3, 6, 7});
}

}  // namespace
}  // namespace tunica::TUNICA_ISA
