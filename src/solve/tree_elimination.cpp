// SPDX-License-Identifier: MIT
#include "solve/tree_elimination.h"

#include <algorithm>

#include "base/aligned.h"

namespace tunica {

namespace {

/// k of each half-edge: the sum of the partials across.
class Coefficients {
 public:
  explicit Coefficients(const Layout& l, const Jacobian& jacobian) {
    const Derivative& d = jacobian.derivative();
    for (size_t p = 0; p < d.variables[0].partials.size(); ++p) {
      if (d.variables[0].partials[p].site == Site::own) continue;
      const System::Values v = jacobian.partial(0, p);
      if (v.per == System::Values::Per::all) {
        same_ += *v.data;
        continue;
      }
      each_.resize(l.edges, 0.0);
      for (Index e = 0; e < l.edges; ++e) each_[e] += v.data[e];
    }
  }
  double operator[](Index edge) const { return each_.empty() ? same_ : same_ + each_[edge]; }
  bool negative() const {
    return !(each_.empty() ? same_ >= 0
                           : std::all_of(each_.begin(), each_.end(), [&](double k) { return same_ + k >= 0; }));
  }

 private:
  double same_ = 0;
  std::vector<double> each_;
};

/// Decay of cell c: minus the derivative when the column is raised everywhere alike.
class Decay {
 public:
  explicit Decay(const System::Values& uniform)
      : values_(uniform.data), stride_(uniform.per == System::Values::Per::all ? 0 : 1) {}
  double operator[](Index c) const { return -values_[c * stride_]; }

 private:
  const double* values_;
  int stride_;
};

[[noreturn]] void fail_undetermined(const System& system, Index c) {
  fail(
      "the steady state is not determined: nothing decays in the piece of tissue around cell {}, so its total stays "
      "what "
      "it is at the start; give it a decay, or run the model to the end",
      system.tissue().id(Kind::cell, c));
}

[[noreturn]] void fail_alone(const System& system, Index c) {
  fail("the steady state is not determined: cell {} neither decays nor exchanges", system.tissue().id(Kind::cell, c));
}

/// Cells numbered along a row: the elimination of a tree without its book-keeping, as one would write it by hand.
class Row {
 public:
  explicit Row(const Layout& l) : n_(l.cells), up_(l.cells, none), down_(l.cells, none) {
    if (n_ < 2 || l.edges != 2 * (n_ - 1)) return;
    for (Index e = 0; e < l.edges; ++e) {
      const Index c = l.own[e], step = l.across[e] - c;
      if (step != 1 && step != -1) return;
      int32_t& place = step == 1 ? up_[c] : down_[c];
      if (place != none) return;  // a second wall between the same cells
      place = e;
    }
    is_row_ = true;
  }
  bool is_row() const { return is_row_; }

  /// False: a coefficient has the wrong sign.
  bool solve(const System& system, const Coefficients& k, const Decay& decay, const double* source, double* b) const {
    if (k.negative()) return false;
    LargeVector<double> pivot(n_);
    double passed_e = 0, passed_b = 0;
    for (Index c = 0; c < n_; ++c) {
      const double e = decay[c] + passed_e;
      if (!(e >= 0)) return false;
      b[c] = source[c] + passed_b;
      pivot[c] = e;
      if (c == n_ - 1) break;
      pivot[c] += k[up_[c]];
      if (!(pivot[c] > 0)) fail_alone(system, c);
      const double passed = k[down_[c + 1]] / pivot[c];
      passed_e = passed * e;
      passed_b = passed * b[c];
    }
    if (!(pivot[n_ - 1] > 0)) fail_undetermined(system, n_ - 1);
    b[n_ - 1] /= pivot[n_ - 1];
    for (Index c = n_ - 1; c-- > 0;) b[c] = (b[c] + k[up_[c]] * b[c + 1]) / pivot[c];
    return true;
  }

 private:
  Index n_;
  LargeVector<int32_t> up_, down_;  ///< half-edge of cell c to c + 1, to c - 1
  bool is_row_ = false;
};

class Elimination {
 public:
  Elimination(const System& system, const Coefficients& k, const Decay& decay, const double* source, double* y)
      : system_(system), l_(system.layout()), k_(k), b_(y) {
    const size_t n = l_.cells;
    first_.resize(n);
    waiting_.resize(n);
    for (size_t c = 0; c < n; ++c) waiting_[c] = 0;
    for (Index e = l_.edges; e-- > 0;) {  // the half-edges of a cell follow each other
      first_[l_.own[e]] = e;
      ++waiting_[l_.own[e]];
    }
    e_.resize(n);
    for (Index c = 0; c < l_.cells; ++c) e_[c] = decay[c];
    std::copy(source, source + n, b_);
    order_.reserve(n);
  }

  bool run() {
    // From each leaf inwards for as long as only one neighbour is left: along a line in one go.
    for (Index start = 0; start < l_.cells; ++start)
      for (Index c = start; c >= 0 && waiting_[c] >= 0 && waiting_[c] <= 1;) {
        if (!(e_[c] >= 0)) return false;
        const int32_t degree = waiting_[c];
        waiting_[c] = gone;
        if (degree == 0) {
          finish_piece(c);
          break;
        }
        c = eliminate(c);
        if (c == refused) return false;
      }
    if (order_.size() != static_cast<size_t>(l_.cells)) return false;  // a cycle is left
    for (auto at = order_.rbegin(); at != order_.rend(); ++at) {
      const Index c = *at, up = first_[c];
      b_[c] = (up < 0 ? b_[c] : b_[c] + k_[up] * b_[l_.across[up]]) / e_[c];
    }
    return true;
  }

 private:
  static constexpr int32_t gone = -1;
  static constexpr Index refused = -2;

  void finish_piece(Index c) {
    if (!(e_[c] > 0)) fail_undetermined(system_, c);
    first_[c] = -1;
    order_.push_back(c);
  }

  /// Adds what cell c passes on to the one neighbour that is left, its parent; e_[c] becomes the pivot.
  Index eliminate(Index c) {
    Index up = first_[c];
    while (waiting_[l_.across[up]] == gone) ++up;
    const Index p = l_.across[up];
    Index down = first_[p];
    while (l_.across[down] != c) ++down;  // two walls between the same cells would be a cycle
    const double k_up = k_[up], k_down = k_[down], pivot = e_[c] + k_up;
    if (!(k_up >= 0) || !(k_down >= 0)) return refused;
    if (!(pivot > 0)) fail_alone(system_, c);
    const double passed = k_down / pivot;
    e_[p] += passed * e_[c];
    b_[p] += passed * b_[c];
    e_[c] = pivot;
    first_[c] = up;
    order_.push_back(c);
    --waiting_[p];
    return p;
  }

  const System& system_;
  const Layout& l_;
  const Coefficients& k_;
  LargeVector<int32_t> first_;    ///< per cell: its first half-edge; once eliminated, that to its parent, or -1
  LargeVector<int32_t> waiting_;  ///< per cell: neighbours that are left
  LargeVector<double> e_;
  double* b_;
  LargeVector<int32_t> order_;
};

}  // namespace

bool solve_tree(const System& system, const Jacobian& jacobian, const double* source, double* y) {
  const Layout& l = system.layout();
  if (jacobian.derivative().uniform == no_node || !jacobian.derivative().order.empty() || l.walls >= l.cells)
    return false;
  const Coefficients k(l, jacobian);
  const Decay decay(jacobian.uniform());
  const Row row(l);
  return row.is_row() ? row.solve(system, k, decay, source, y) : Elimination(system, k, decay, source, y).run();
}

}  // namespace tunica
