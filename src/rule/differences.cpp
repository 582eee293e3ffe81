// SPDX-License-Identifier: MIT
#include "rule/differences.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace tunica {

namespace {

constexpr int furthest = 4;
constexpr double relative_step = 1.5e-8;  ///< square root of the rounding error

/// The cells that hold an element: itself, a side's own, a wall's two.
void homes(const Tissue& t, Kind kind, Index element, std::vector<int32_t>& cells) {
  cells.clear();
  if (kind == Kind::cell) cells.push_back(element);
  if (kind == Kind::side) cells.push_back(t.cell_of(element));
  if (kind != Kind::wall) return;
  for (const int which : {0, 1}) {
    const Index side = t.wall_side(element, which);
    if (side != none) cells.push_back(t.cell_of(side));
  }
}

/// Largest magnitude in a column; 1 if all are zero.
double largest(const double* values, Index count) {
  double found = 0;
  for (Index i = 0; i < count; ++i) found = std::max(found, std::fabs(values[i]));
  return found > 0 ? found : 1;
}

}  // namespace

void Differences::prepare(const std::vector<int32_t>& offsets, SparseRows& j) {
  offsets_ = offsets;
  place_.clear();
  for (const System::StateColumn& s : system_.state())
    for (Index i = 0; i < s.count; ++i) place_.push_back(static_cast<int32_t>(s.offset) + i);
  for (AlignedBuffer* buffer : {&moved_, &base_, &rates_}) buffer->resize(system_.state_size());
  build(j);
  find_reach(j);
}

/// At the state that the tissue holds: the pattern must stand before a method takes it on.
void Differences::find_reach(SparseRows& j) {
  AlignedBuffer y;
  y.resize(system_.state_size());
  system_.read_state(y.data());
  struct Restore {
    System& system;
    const double* state;
    ~Restore() { system.write_state(state); }
  } restore{system_, y.data()};  // rules that run as they are see what is tried in the tissue
  evaluate(0, y.data(), j);
  while (!holds(0, y.data(), j)) {
    if (++reach_ > furthest)
      fail(
          "the rates depend on cells more than {} walls away, or jump, so that no sparse derivative describes them; "
          "use an "
          "explicit method (heun, rkc2)",
          furthest);
    build(j);
    evaluate(0, y.data(), j);
  }
}

/// Per cell: those at most reach_ walls away.
std::vector<std::vector<int32_t>> Differences::cells_within_reach() const {
  const Layout& l = system_.layout();
  std::vector<std::vector<int32_t>> next(l.cells), found(l.cells);
  for (Index e = 0; e < l.edges; ++e) next[l.own[e]].push_back(l.across[e]);
  for (Index c = 0; c < l.cells; ++c) {
    std::vector<int32_t>& ball = found[c];
    ball = {c};
    for (int ring = 0; ring < reach_; ++ring) {
      const std::vector<int32_t> before = ball;
      for (const int32_t x : before) ball.insert(ball.end(), next[x].begin(), next[x].end());
      std::sort(ball.begin(), ball.end());
      ball.erase(std::unique(ball.begin(), ball.end()), ball.end());
    }
  }
  return found;
}

void Differences::build(SparseRows& j) {
  const Tissue& t = system_.tissue();
  const std::vector<std::vector<int32_t>> ball = cells_within_reach();
  std::vector<std::vector<int32_t>> of_cell(t.cells());  // unknowns held by each
  std::vector<int32_t> cells;
  for (size_t k = 0; k < system_.state().size(); ++k)
    for (Index i = 0; i < system_.state()[k].count; ++i) {
      homes(t, system_.state()[k].kind, i, cells);
      for (const int32_t c : cells) of_cell[c].push_back(offsets_[k] + i);
    }
  j = {};
  j.begin.push_back(0);
  std::vector<int32_t> columns;
  for (size_t k = 0; k < system_.state().size(); ++k)
    for (Index i = 0; i < system_.state()[k].count; ++i) {
      homes(t, system_.state()[k].kind, i, cells);
      columns.clear();
      for (const int32_t home : cells)
        for (const int32_t c : ball[home]) columns.insert(columns.end(), of_cell[c].begin(), of_cell[c].end());
      std::sort(columns.begin(), columns.end());
      columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
      j.column.insert(j.column.end(), columns.begin(), columns.end());
      j.begin.push_back(static_cast<int32_t>(j.column.size()));
    }
  j.value.assign(j.column.size(), 0.0);
  colour(j);
}

/// Greedy colouring: unknowns of a colour share no row.
void Differences::colour(const SparseRows& j) {
  const int n = j.rows();
  std::vector<std::vector<Entry>> of_unknown(n);
  for (int row = 0; row < n; ++row)
    for (int32_t k = j.begin[row]; k < j.begin[row + 1]; ++k) of_unknown[j.column[k]].push_back({row, k});
  std::vector<int32_t> colour_of(n, -1), taken;
  unknowns_.clear();
  entries_.clear();
  for (int u = 0; u < n; ++u) {
    taken.assign(unknowns_.size() + 1, 0);
    for (const Entry& e : of_unknown[u])
      for (int32_t k = j.begin[e.row]; k < j.begin[e.row + 1]; ++k)
        if (colour_of[j.column[k]] >= 0) taken[colour_of[j.column[k]]] = 1;
    const auto free = static_cast<size_t>(std::find(taken.begin(), taken.end(), 0) - taken.begin());
    if (free == unknowns_.size()) unknowns_.emplace_back(), entries_.emplace_back();
    colour_of[u] = static_cast<int32_t>(free);
    unknowns_[free].push_back(u);
    entries_[free].insert(entries_[free].end(), of_unknown[u].begin(), of_unknown[u].end());
  }
}

void Differences::evaluate(double t, const double* y, SparseRows& j) {
  const size_t size = system_.state_size();
  system_.rates(t, y, base_.data());
  std::copy(y, y + size, moved_.data());
  std::vector<double> step(place_.size());
  for (size_t k = 0; k < system_.state().size(); ++k) {
    const System::StateColumn& s = system_.state()[k];
    const double scale = largest(y + s.offset, s.count);
    for (Index i = 0; i < s.count; ++i) {
      const double at = y[s.offset + i], wanted = relative_step * std::max(std::fabs(at), 1e-3 * scale);
      step[offsets_[k] + i] = (at + wanted) - at;  // what is in fact added
    }
  }
  for (size_t c = 0; c < unknowns_.size(); ++c) {
    for (const int32_t u : unknowns_[c]) moved_.data()[place_[u]] += step[u];
    system_.rates(t, moved_.data(), rates_.data());
    for (const Entry& e : entries_[c])
      j.value[e.place] = (rates_.data()[place_[e.row]] - base_.data()[place_[e.row]]) / step[j.column[e.place]];
    for (const int32_t u : unknowns_[c]) moved_.data()[place_[u]] = y[place_[u]];
  }
}

/// Whether J v is the change of the rates along a random direction v.
bool Differences::holds(double t, const double* y, const SparseRows& j) {
  const int n = j.rows();
  std::vector<double> v(n), product(n);
  double most = 0, worst = 0;
  for (size_t k = 0; k < system_.state().size(); ++k) {
    const double scale = largest(y + system_.state()[k].offset, system_.state()[k].count);
    for (int u = offsets_[k]; u < offsets_[k + 1]; ++u) {
      v[u] = (0.5 + uniform({17, purpose("differences"), static_cast<uint64_t>(u)})) *
             std::max(1e-3 * scale, std::fabs(y[place_[u]]));
      moved_.data()[place_[u]] = y[place_[u]] + 1e-6 * v[u];
    }
  }
  system_.rates(t, moved_.data(), rates_.data());
  j.multiply(v.data(), product.data());
  for (int row = 0; row < n; ++row) {
    const double seen = (rates_.data()[place_[row]] - base_.data()[place_[row]]) / 1e-6;
    most = std::max(most, std::fabs(seen));
    const double difference = std::fabs(seen - product[row]);
    if (!(difference <= worst)) worst = difference;
  }
  return worst <= 1e-3 * most || !std::isfinite(most);
}

}  // namespace tunica
