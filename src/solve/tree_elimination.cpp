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

 private:
  double same_ = 0;
  std::vector<double> each_;
};

class Elimination {
 public:
  Elimination(const System& system, const Jacobian& jacobian, const double* source, double* y)
      : system_(system), l_(system.layout()), k_(l_, jacobian), b_(y) {
    const size_t n = l_.cells;
    first_.resize(n);
    waiting_.resize(n);
    for (size_t c = 0; c < n; ++c) waiting_[c] = 0;
    for (Index e = l_.edges; e-- > 0;) {  // the half-edges of a cell follow each other
      first_[l_.own[e]] = e;
      ++waiting_[l_.own[e]];
    }
    const System::Values uniform = jacobian.uniform();
    const bool same = uniform.per == System::Values::Per::all;
    e_.resize(n);
    for (size_t c = 0; c < n; ++c) e_[c] = -uniform.data[same ? 0 : c];
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
    if (!(e_[c] > 0))
      fail(
          "the steady state is not determined: nothing decays in the piece of tissue around cell {}, so its total "
          "stays "
          "what it is at the start; give it a decay, or run the model to the end",
          system_.tissue().id(Kind::cell, c));
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
    if (!(pivot > 0))
      fail("the steady state is not determined: cell {} neither decays nor exchanges",
           system_.tissue().id(Kind::cell, c));
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
  Coefficients k_;
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
  return Elimination(system, jacobian, source, y).run();
}

}  // namespace tunica
