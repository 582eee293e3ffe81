// SPDX-License-Identifier: MIT
// The inner loops, compiled once per instruction set with TUNICA_ISA (namespace) and TUNICA_VECTOR_BYTES set.
// Everything is in that namespace and nothing here calls inline library code, so that no function compiled for one
// instruction set can be linked in for another. Rounding is that of single operations throughout: no contraction.

#include <math.h>

#include "rule/kernels.h"

namespace tunica::TUNICA_ISA {
namespace {

constexpr int lanes = TUNICA_VECTOR_BYTES / 8;
typedef double V __attribute__((vector_size(TUNICA_VECTOR_BYTES), may_alias));
typedef double Unaligned __attribute__((vector_size(TUNICA_VECTOR_BYTES), may_alias, aligned(8)));
typedef long long L __attribute__((vector_size(TUNICA_VECTOR_BYTES), may_alias));

inline V all(double x) { return V{} + x; }  // only for x that is not a signed zero
inline V broadcast(double x) {
  V v;
  for (int i = 0; i < lanes; ++i) v[i] = x;
  return v;
}
inline V choose(L mask, V yes, V no) { return (V)(((L)yes & mask) | ((L)no & ~mask)); }

// --- exp: x = n ln 2 + r, |r| <= ln 2 / 2; polynomial of degree 13 (Taylor coefficients, remainder < 1e-17); about 1 ulp.
// Overflows to infinity, underflows to 0 below the normal range; NaN stays NaN.
inline V exponential(V x) {
  const V shift = broadcast(0x1.8p52);
  const V biased = x * broadcast(1.44269504088896338700) + shift;
  const V n = biased - shift;
  V r = x - n * broadcast(6.93147180369123816490e-01);
  r = r - n * broadcast(1.90821492927058770002e-10);
  constexpr double c[] = {1.0 / 6227020800.0, 1.0 / 479001600.0, 1.0 / 39916800.0, 1.0 / 3628800.0, 1.0 / 362880.0, 1.0 / 40320.0,
                          1.0 / 5040.0, 1.0 / 720.0, 1.0 / 120.0, 1.0 / 24.0, 1.0 / 6.0, 0.5};
  V p = broadcast(c[0]);
  for (int k = 1; k < 12; ++k) p = p * r + broadcast(c[k]);
  p = (p * r) * r + r;  // exp(r) - 1, so that the leading 1 costs no digits
  const L exponent = ((L)biased << 52);
  const V scaled = (V)((L)(p + broadcast(1.0)) + exponent);
  V result = choose(x > broadcast(709.782712893384), broadcast(__builtin_inf()), scaled);
  result = choose(x < broadcast(-708.39641853226408), broadcast(0.0), result);
  return choose(x != x, x, result);
}

template <double (*F)(double)>
inline V each(V x) {
  for (int i = 0; i < lanes; ++i) x[i] = F(x[i]);
  return x;
}

template <Code code>
inline V operate(V a, V b, V c) {
  const V nan = broadcast(__builtin_nan(""));
  const V one = broadcast(1.0), zero = broadcast(0.0);
  if constexpr (code == Code::neg) return -a;
  if constexpr (code == Code::exp) return exponential(a);
  if constexpr (code == Code::log) return each<::log>(a);
  if constexpr (code == Code::sqrt) return each<::sqrt>(a);
  if constexpr (code == Code::sin) return each<::sin>(a);
  if constexpr (code == Code::cos) return each<::cos>(a);
  if constexpr (code == Code::tanh) return each<::tanh>(a);
  if constexpr (code == Code::abs) return (V)((L)a & (L{} + 0x7fffffffffffffffLL));
  if constexpr (code == Code::add) return a + b;
  if constexpr (code == Code::sub) return a - b;
  if constexpr (code == Code::mul) return a * b;
  if constexpr (code == Code::div) return a / b;
  if constexpr (code == Code::pow) {
    for (int i = 0; i < lanes; ++i) a[i] = ::pow(a[i], b[i]);
    return a;
  }
  if constexpr (code == Code::min) return choose(a != a, a, choose(a < b, a, b));
  if constexpr (code == Code::max) return choose(a != a, a, choose(a > b, a, b));
  if constexpr (code == Code::less) return choose((a != a) | (b != b), nan, choose(a < b, one, zero));
  if constexpr (code == Code::less_equal) return choose((a != a) | (b != b), nan, choose(a <= b, one, zero));
  if constexpr (code == Code::equal) return choose((a != a) | (b != b), nan, choose(a == b, one, zero));
  if constexpr (code == Code::select) return choose(a != a, nan, choose(a != zero, b, c));
  if constexpr (code == Code::multiply_add) return a * b + c;
  if constexpr (code == Code::multiply_subtract) return a * b - c;
  if constexpr (code == Code::subtract_multiply) return c - a * b;
  if constexpr (code == Code::subtract_max) return operate<Code::max>(a - b, c, c);
  return a;
}

template <Code code, int mask>
void elementwise(const Operands& o) {
  const V sa = broadcast(o.sa), sb = broadcast(o.sb), sc = broadcast(o.sc);
  // Blocks are padded to whole rounds of four vectors; one loop test for each round.
  constexpr int round = 4 * lanes;
  const int rounds = (o.count + round - 1) / round * round;
#pragma GCC unroll 4
  for (int i = 0; i < rounds; i += lanes) {
    const V a = mask & 1 ? sa : *(const V*)(o.a + i);
    const V b = mask & 2 ? sb : *(const V*)(o.b + i);
    const V c = mask & 4 ? sc : *(const V*)(o.c + i);
    *(V*)(o.dst + i) = operate<code>(a, b, c);
  }
}

template <Code code>
void fill(Kernels& k) {
  auto& row = k.elementwise[(int)code];
  row[0] = elementwise<code, 0>, row[1] = elementwise<code, 1>, row[2] = elementwise<code, 2>, row[3] = elementwise<code, 3>;
  row[4] = elementwise<code, 4>, row[5] = elementwise<code, 5>, row[6] = elementwise<code, 6>, row[7] = elementwise<code, 7>;
}

template <int first, int last>
void fill_all(Kernels& k) {
  fill<(Code)first>(k);
  if constexpr (first + 1 < last) fill_all<first + 1, last>(k);
}

// --- Sums over neighbours. A row is read as one vector; the order of additions is the cyclic order of the neighbours.
template <int width>
struct RowType {
  typedef double type __attribute__((vector_size(width * 8), may_alias));
};
template <>
struct RowType<1> {
  typedef double type;
};

template <int width, bool weighted, bool subtract, int unrolled>
inline void gather_run(const GatherArguments& g, int neighbours, int cells, const uint8_t* position, int edge,
                       typename RowType<width>::type keep) {
  using R = typename RowType<width>::type;
  typedef long long LR __attribute__((vector_size(width == 1 ? 16 : width * 8), may_alias));
  const int n = unrolled ? unrolled : neighbours;
  const int32_t* across = g.layout->across + edge;
  const double* weights = weighted ? g.weights + edge : nullptr;
  const R* rows = (const R*)g.rows[0];
  const R* block_rows = rows + (long)g.block * block_size;
  for (int i = 0; i < cells; ++i, across += n) {
    R own{};
    if constexpr (subtract) {
      own = block_rows[position[i]];
      if constexpr (width > 1) own = (R)((LR)own & (LR)keep);
    }
    R sum{};
    for (int q = 0; q < n; ++q) {
      R term = rows[across[q]];
      if constexpr (subtract) term = term - own;
      if constexpr (weighted) term = term * weights[q];
      sum = q == 0 ? term : sum + term;
    }
    if constexpr (weighted) weights += n;
    if constexpr (width == 1) {
      g.out[0][position[i]] = sum;
    } else {
      for (int j = 0; j < width; ++j)
        if (width < 4 || j < g.columns) g.out[j][position[i]] = sum[j];
    }
  }
}

/// One column over a stretch of a grid: the neighbours of consecutive cells are consecutive, so whole vectors add up.
template <int unrolled>
inline void gather_consecutive(const double* column, const int32_t* across, int neighbours, int cells, const double* own,
                               double* out) {
  const int n = unrolled ? unrolled : neighbours;
  int ahead = across[0];
  for (int q = 1; q < n; ++q) ahead = across[q] > ahead ? across[q] : ahead;
  ahead += block_size;
  for (int i = 0; i < cells; i += lanes) {
    if (i + lanes > cells) i = cells - lanes;  // the last vector overlaps the one before it
    __builtin_prefetch(column + ahead + i);
    const V less = own ? (V)*(const Unaligned*)(own + i) : V{};
    V sum{};
    for (int q = 0; q < n; ++q) {
      V term = (V)*(const Unaligned*)(column + across[q] + i);
      if (own) term = term - less;
      sum = q == 0 ? term : sum + term;
    }
    *(Unaligned*)(out + i) = (Unaligned)sum;
  }
}

void gather_consecutive(const GatherArguments& g, int column, int edge, int neighbours, int cells, int position) {
  const double *values = g.rows[column], *own = g.difference >> column & 1 ? values + (long)g.block * block_size + position : nullptr;
  const int32_t* across = g.layout->across + edge;
  double* out = g.out[column] + position;
  switch (neighbours) {
    case 2: return gather_consecutive<2>(values, across, 2, cells, own, out);
    case 4: return gather_consecutive<4>(values, across, 4, cells, own, out);
    case 6: return gather_consecutive<6>(values, across, 6, cells, own, out);
    default: return gather_consecutive<0>(values, across, neighbours, cells, own, out);
  }
}

template <int width, bool weighted, bool subtract>
void gather_block(const GatherArguments& g) {
  using R = typename RowType<width>::type;
  R keep{};
  if constexpr (width > 1) {
    for (int j = 0; j < width; ++j) {
      const long long bits = g.difference >> j & 1 ? -1LL : 0LL;
      __builtin_memcpy((char*)&keep + 8 * j, &bits, 8);
    }
  }
  const LayoutView& l = *g.layout;
  const uint8_t* position = l.position + (long)g.block * block_size;
  int edge = l.edge_begin[g.block];
  for (int r = l.run_begin[g.block]; r < l.run_begin[g.block + 1]; ++r) {
    const int n = l.runs[r].neighbours, cells = l.runs[r].cells;
    if (width == 1 && !weighted && l.runs[r].consecutive)
      gather_consecutive(g, 0, edge, n, cells, *position);
    else switch (n) {
      case 2: gather_run<width, weighted, subtract, 2>(g, n, cells, position, edge, keep); break;
      case 3: gather_run<width, weighted, subtract, 3>(g, n, cells, position, edge, keep); break;
      case 4: gather_run<width, weighted, subtract, 4>(g, n, cells, position, edge, keep); break;
      case 5: gather_run<width, weighted, subtract, 5>(g, n, cells, position, edge, keep); break;
      case 6: gather_run<width, weighted, subtract, 6>(g, n, cells, position, edge, keep); break;
      case 7: gather_run<width, weighted, subtract, 7>(g, n, cells, position, edge, keep); break;
      case 8: gather_run<width, weighted, subtract, 8>(g, n, cells, position, edge, keep); break;
      default: gather_run<width, weighted, subtract, 0>(g, n, cells, position, edge, keep); break;
    }
    position += cells;
    edge += n * cells;
  }
}

template <int width>
void gather(const GatherArguments& g) {
  if (g.weights)
    g.difference ? gather_block<width, true, true>(g) : gather_block<width, true, false>(g);
  else
    g.difference ? gather_block<width, false, true>(g) : gather_block<width, false, false>(g);
}

// The same sums straight from two columns, where packing them would cost more than it saves.
template <bool weighted, int unrolled>
inline void gather_two_run(const GatherArguments& g, int neighbours, int cells, const uint8_t* position, int edge) {
  const int n = unrolled ? unrolled : neighbours;
  const int32_t* across = g.layout->across + edge;
  const double* weights = weighted ? g.weights + edge : nullptr;
  const double *first = g.rows[0], *second = g.rows[1];
  const long base = (long)g.block * block_size;
  const bool first_less = g.difference & 1, second_less = g.difference & 2;
  for (int i = 0; i < cells; ++i, across += n) {
    const double own_first = first_less ? first[base + position[i]] : 0.0;
    const double own_second = second_less ? second[base + position[i]] : 0.0;
    double sum_first = 0, sum_second = 0;
    for (int q = 0; q < n; ++q) {
      double x = first[across[q]] - own_first, y = second[across[q]] - own_second;
      if constexpr (weighted) x = x * weights[q], y = y * weights[q];
      sum_first = q == 0 ? x : sum_first + x;
      sum_second = q == 0 ? y : sum_second + y;
    }
    if constexpr (weighted) weights += n;
    g.out[0][position[i]] = sum_first;
    g.out[1][position[i]] = sum_second;
  }
}

template <bool weighted>
void gather_two_block(const GatherArguments& g) {
  const LayoutView& l = *g.layout;
  const uint8_t* position = l.position + (long)g.block * block_size;
  int edge = l.edge_begin[g.block];
  for (int r = l.run_begin[g.block]; r < l.run_begin[g.block + 1]; ++r) {
    const int n = l.runs[r].neighbours, cells = l.runs[r].cells;
    if (!weighted && l.runs[r].consecutive) {
      gather_consecutive(g, 0, edge, n, cells, *position);
      gather_consecutive(g, 1, edge, n, cells, *position);
    } else switch (n) {
      case 2: gather_two_run<weighted, 2>(g, n, cells, position, edge); break;
      case 4: gather_two_run<weighted, 4>(g, n, cells, position, edge); break;
      case 5: gather_two_run<weighted, 5>(g, n, cells, position, edge); break;
      case 6: gather_two_run<weighted, 6>(g, n, cells, position, edge); break;
      case 7: gather_two_run<weighted, 7>(g, n, cells, position, edge); break;
      default: gather_two_run<weighted, 0>(g, n, cells, position, edge); break;
    }
    position += cells;
    edge += n * cells;
  }
}

void gather_two(const GatherArguments& g) { g.weights ? gather_two_block<true>(g) : gather_two_block<false>(g); }

template <int width>
void pack(double* rows, const double* const* values, int count) {
  const double *a = values[0], *b = values[width > 1 ? 1 : 0], *c = values[width > 2 ? 2 : 0], *d = values[width > 2 ? 3 : 0];
  for (int i = 0; i < count; ++i) {
    rows[width * i] = a[i];
    if constexpr (width > 1) rows[width * i + 1] = b[i];
    if constexpr (width > 2) {
      rows[width * i + 2] = c[i];
      rows[width * i + 3] = d[i];
    }
  }
}

// --- Values per half-edge or wall to one per cell. A cell without neighbours gets 0.
enum class Reduce { sum, minimum, maximum };

template <Reduce how>
void reduce_edges(const LayoutView& l, int block, const double* values, double* out) {
  const uint8_t* position = l.position + (long)block * block_size;
  const double* v = values + l.edge_begin[block];
  for (int r = l.run_begin[block]; r < l.run_begin[block + 1]; ++r) {
    const int n = l.runs[r].neighbours;
    for (int i = 0; i < l.runs[r].cells; ++i, v += n) {
      double total = n ? v[0] : 0.0;
      for (int q = 1; q < n; ++q) {
        if constexpr (how == Reduce::sum) total = total + v[q];
        if constexpr (how == Reduce::minimum) total = total != total ? total : (total < v[q] ? total : v[q]);
        if constexpr (how == Reduce::maximum) total = total != total ? total : (total > v[q] ? total : v[q]);
      }
      out[*position++] = total;
    }
  }
}

/// `index`: of a half-edge's wall, among the values or, on the wall's second side, among their negatives that follow them.
template <int unrolled>
inline void wall_sum_run(const double* values, const int32_t* index, int neighbours, int cells, const uint8_t* position, double* out) {
  const int n = unrolled ? unrolled : neighbours;
  for (int i = 0; i < cells; ++i, index += n) {
    double total = n ? values[index[0]] : 0.0;
    for (int q = 1; q < n; ++q) total = total + values[index[q]];
    out[position[i]] = total;
  }
}

void wall_sum(const LayoutView& l, int block, const double* values, double* out) {
  const uint8_t* position = l.position + (long)block * block_size;
  const int32_t* index = l.signed_wall + l.edge_begin[block];
  for (int r = l.run_begin[block]; r < l.run_begin[block + 1]; ++r) {
    const int n = l.runs[r].neighbours, cells = l.runs[r].cells;
    switch (n) {
      case 4: wall_sum_run<4>(values, index, n, cells, position, out); break;
      case 5: wall_sum_run<5>(values, index, n, cells, position, out); break;
      case 6: wall_sum_run<6>(values, index, n, cells, position, out); break;
      case 7: wall_sum_run<7>(values, index, n, cells, position, out); break;
      case 8: wall_sum_run<8>(values, index, n, cells, position, out); break;
      default: wall_sum_run<0>(values, index, n, cells, position, out); break;
    }
    position += cells;
    index += n * cells;
  }
}

void fetch(double* dst, const double* values, const int32_t* index, int count) {
  for (int i = 0; i < count; ++i) dst[i] = values[index[i]];
}

/// y + h * rate over a block; `rate(i)` gives a vector of rates, `rate_of(i)` one.
template <class Rates, class Rate>
inline uint8_t advance_by(const AdvanceArguments& g, Rates rates, Rate rate_of) {
  const V h = broadcast(g.h);
  L bad{}, below{};
  int i = 0;
#pragma GCC unroll 4
  for (; i + lanes <= g.count; i += lanes) {
    __builtin_prefetch(g.y_new + i + block_size, 1);
    const V y = *(const V*)(g.y + i) + h * rates(i);
    *(V*)(g.y_new + i) = y;
    bad |= (y - y) != (y - y);
    below |= y < broadcast(0.0);
  }
  uint8_t found = 0;
  for (int j = 0; j < lanes; ++j) found |= (uint8_t)((bad[j] ? not_finite : 0) | (below[j] ? negative : 0));
  for (; i < g.count; ++i) {
    const double y = g.y[i] + g.h * rate_of(i);
    g.y_new[i] = y;
    found |= (uint8_t)(((y - y) != (y - y) ? not_finite : 0) | (y < 0 ? negative : 0));
  }
  return found;
}

uint8_t advance(const AdvanceArguments& g) {
  if (g.rate) return advance_by(g, [&](int i) { return *(const V*)(g.rate + i); }, [&](int i) { return g.rate[i]; });
  const V fixed = broadcast(g.scalar_rate);
  return advance_by(g, [&](int) { return fixed; }, [&](int) { return g.scalar_rate; });
}

template <int mask>
uint8_t advance_multiply_add(const AdvanceArguments& g, const Operands& o) {
  const V sa = broadcast(o.sa), sb = broadcast(o.sb), sc = broadcast(o.sc);
  return advance_by(
      g,
      [&](int i) {
        const V a = mask & 1 ? sa : *(const V*)(o.a + i);
        const V b = mask & 2 ? sb : *(const V*)(o.b + i);
        const V c = mask & 4 ? sc : *(const V*)(o.c + i);
        return a * b + c;
      },
      [&](int i) { return (mask & 1 ? o.sa : o.a[i]) * (mask & 2 ? o.sb : o.b[i]) + (mask & 4 ? o.sc : o.c[i]); });
}

template <int mask>
void fill_advance(Kernels& k) {
  k.advance_multiply_add[mask] = advance_multiply_add<mask>;
  if constexpr (mask < 7) fill_advance<mask + 1>(k);
}

}  // namespace

const Kernels& kernels() {
  static const Kernels set = [] {
    Kernels k{};
    k.name = TUNICA_ISA_NAME;
    fill_all<0, (int)Code::elementwise_count>(k);
    k.gather[0] = gather<1>, k.gather[1] = gather<2>, k.gather[2] = gather<4>;
    k.gather_two = gather_two;
    k.pack[0] = pack<1>, k.pack[1] = pack<2>, k.pack[2] = pack<4>;
    k.edge_sum = reduce_edges<Reduce::sum>;
    k.edge_minimum = reduce_edges<Reduce::minimum>;
    k.edge_maximum = reduce_edges<Reduce::maximum>;
    k.wall_sum = wall_sum;
    k.fetch = fetch;
    k.advance = advance;
    fill_advance<0>(k);
    return k;
  }();
  return set;
}

}  // namespace tunica::TUNICA_ISA
