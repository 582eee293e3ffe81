// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "shape/apex_kernels.h"

namespace tunica {

/// N functions of one variable that cost much, as Hermite's cubics: even steps between given breaks, halved until the
/// error in the middle of each is within a tolerance. Reading one costs some nanoseconds.
template <size_t N>
class Table {
 public:
  using Values = std::array<double, N>;
  static constexpr size_t most_steps = 1u << 15;

  Table() = default;
  /// @param breaks  increasing, two or more; between two of them the functions are smooth
  /// @param f       void(x, Values& value, Values& slope); at a break it may be asked for the side of either span
  /// @param tolerance  largest error allowed; if it cannot be met in most_steps steps the table is empty
  template <class F>
  Table(const std::vector<double>& breaks, const F& f, double tolerance) {
    for (size_t i = 0; i + 1 < breaks.size(); ++i)
      if (!add(breaks[i], breaks[i + 1], f, tolerance)) {
        *this = {};
        return;
      }
  }

  explicit operator bool() const { return !cubics_.empty(); }
  double first() const { return spans_.front().from; }
  double last() const { return last_; }
  size_t steps() const { return cubics_.size(); }
  /// Where the steps start.
  double start(size_t step) const {
    const Span& s = spans_[span_of_step(step)];
    return s.from + static_cast<double>(step - s.first) / s.per_x;
  }

  /// A place in the table: step, share of it gone (0 .. 1), steps per unit of x.
  struct Place {
    size_t step;
    double s, per_x;
  };
  /// Of an x from first() to last().
  Place find(double x) const {
    const Span* span = spans_.data();
    for (const Span* end = span + spans_.size() - 1; span != end && x >= span[1].from;) ++span;
    const double at = std::max(0., (x - span->from) * span->per_x);
    const size_t k = std::min(static_cast<size_t>(at), span->count - 1);
    return {span->first + k, at - static_cast<double>(k), span->per_x};
  }
  double value(const Place& p, size_t i) const {
    const double* c = cubics_[p.step].data() + 4 * i;
    return c[0] + p.s * (c[1] + p.s * (c[2] + p.s * c[3]));
  }
  double slope(const Place& p, size_t i) const {
    const double* c = cubics_[p.step].data() + 4 * i;
    return p.per_x * (c[1] + p.s * (2 * c[2] + 3 * p.s * c[3]));
  }
  double bend(const Place& p, size_t i) const {
    const double* c = cubics_[p.step].data() + 4 * i;
    return p.per_x * p.per_x * (2 * c[2] + 6 * p.s * c[3]);
  }

  /// For the kernels, while this table lives. False: it has more spans than they can take.
  bool view(TableView& view) const {
    if (cubics_.empty() || spans_.size() > TableView::most_spans) return false;
    view = {cubics_[0].data(), static_cast<int>(N), static_cast<int>(spans_.size()), first(), last_, {}, {}, {}, {}};
    for (size_t i = 0; i < spans_.size(); ++i) {
      view.from[i] = spans_[i].from, view.per_x[i] = spans_[i].per_x;
      view.first_step[i] = static_cast<double>(spans_[i].first);
      view.last_step[i] = static_cast<double>(spans_[i].first + spans_[i].count - 1);
    }
    return true;
  }

 private:
  struct Span {
    double from, per_x;
    size_t first, count;
  };
  using Cubic = std::array<double, 4 * N>;

  size_t span_of_step(size_t step) const {
    size_t i = 0;
    while (i + 1 < spans_.size() && spans_[i + 1].first <= step) ++i;
    return i;
  }

  template <class F>
  bool add(double from, double to, const F& f, double tolerance) {
    const size_t first = cubics_.size();
    for (size_t count = 8; first + count <= most_steps; count *= 2) {
      const double h = (to - from) / static_cast<double>(count);
      cubics_.resize(first + count);
      Values p, dp, q, dq, m, dm;
      bool good = true;
      f(from, p, dp);
      for (size_t k = 0; k < count; ++k, p = q, dp = dq) {
        const double x = from + h * static_cast<double>(k);
        const double short_by = k + 1 == count ? 1e-9 * h : 0;  // of what may be a corner
        f(k + 1 == count ? to - short_by : x + h, q, dq);
        for (size_t i = 0; i < N; ++i) q[i] += short_by * dq[i];
        for (size_t i = 0; i < N; ++i) {
          const double rise = q[i] - p[i], a = h * dp[i], b = h * dq[i];
          const double c[] = {p[i], a, 3 * rise - 2 * a - b, a + b - 2 * rise};
          std::copy(c, c + 4, cubics_[first + k].begin() + static_cast<long>(4 * i));
        }
        f(x + h / 2, m, dm);
        for (size_t i = 0; i < N; ++i) {
          const double* c = cubics_[first + k].data() + 4 * i;
          good = good && std::abs(c[0] + .5 * (c[1] + .5 * (c[2] + .5 * c[3])) - m[i]) <= tolerance;
        }
        if (!good) break;
      }
      if (good) {
        spans_.push_back({from, 1 / h, first, count});
        last_ = to;
        return true;
      }
    }
    return false;
  }

  std::vector<Span> spans_;
  std::vector<Cubic> cubics_;
  double last_ = 0;
};

}  // namespace tunica
