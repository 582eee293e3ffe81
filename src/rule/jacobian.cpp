// SPDX-License-Identifier: MIT
#include "rule/jacobian.h"

#include <algorithm>
#include <cstring>

#include "rule/differences.h"

namespace tunica {

int32_t SparseRows::place(int row, int32_t col) const {
  const auto first = column.begin() + begin[row], last = column.begin() + begin[row + 1];
  const auto at = std::lower_bound(first, last, col);
  if (at == last || *at != col) fail("internal: entry {}, {} is not in the pattern", row, col);
  return static_cast<int32_t>(at - column.begin());
}

void SparseRows::multiply(const double* v, double* out) const {
  for (int i = 0; i < rows(); ++i) {
    double sum = 0;
    for (int32_t k = begin[i]; k < begin[i + 1]; ++k) sum += value[k] * v[column[k]];
    out[i] = sum;
  }
}

Jacobian::Jacobian(System& system) : system_(system) {
  std::vector<int> state;
  for (const System::StateColumn& s : system.state()) state.push_back(s.column);
  derivative_ = differentiate(system.equations(), state);
  if (!derivative_.missing.empty()) {
    differences_ = std::make_unique<Differences>(system);
    return;
  }
  std::vector<NodeId> nodes;
  for (const Derivative::Variable& variable : derivative_.variables) {
    value_of_.emplace_back();
    for (const Partial& partial : variable.partials) {
      value_of_.back().push_back(nodes.size());
      nodes.push_back(partial.value);
    }
  }
  matrix_of_.assign(derivative_.variables.size(), -1);
  for (size_t k = 0; k < derivative_.order.size(); ++k) matrix_of_[derivative_.order[k]] = static_cast<int>(k) + 1;
  if (derivative_.uniform != no_node) {
    uniform_value_ = nodes.size();
    nodes.push_back(derivative_.uniform);
  }
  system.add_values(nodes);
}

Jacobian::~Jacobian() = default;

// === Pattern

namespace {

/// Half-edges a value of a wall or side stands for: walls count once, on their first side.
bool stands_for(const Layout& l, Kind kind, int e) { return kind != Kind::wall || l.signed_wall[e] < l.wall_stride; }

}  // namespace

int32_t Jacobian::element(Site site, int e) const {
  const Layout& l = system_.layout();
  switch (site) {
    case Site::own:
      return l.own[e];
    case Site::across:
      return l.across[e];
    case Site::here:
      return l.side[e];
    case Site::there:
      return l.mirror[e];
    case Site::wall:
      return l.wall[e];
  }
  return 0;
}

int32_t Jacobian::row_of(Kind kind, int e) const {
  const Layout& l = system_.layout();
  return kind == Kind::cell ? l.own[e] : kind == Kind::wall ? l.wall[e] : l.side[e];
}

/// One number of the matrix: row, the variable's element, and which value of the partial it is.
struct Jacobian::Entry {
  int32_t row, element, source;
};

void Jacobian::prepare() {
  const Tissue& tissue = system_.tissue();
  if (structure_ == tissue.topology_version()) {
    for (Filling& f : fillings_)
      for (Block& block : f.blocks) block.written = false;
    return;
  }
  structure_ = tissue.topology_version();
  offsets_.assign(1, 0);
  for (const System::StateColumn& s : system_.state()) offsets_.push_back(offsets_.back() + s.count);
  size_ = offsets_.back();
  if (differences_) {
    matrices_.resize(1);
    return differences_->prepare(offsets_, matrices_[0]);
  }
  matrices_.assign(derivative_.order.size() + 1, {});
  fillings_.assign(matrices_.size(), {});
  for (size_t k = 0; k < derivative_.order.size(); ++k) build(static_cast<int>(k) + 1, {derivative_.order[k]});
  std::vector<int> states(derivative_.states);
  for (int k = 0; k < derivative_.states; ++k) states[k] = k;
  build(0, states);
}

void Jacobian::build(int matrix, const std::vector<int>& variables) {
  const Layout& l = system_.layout();
  struct Piece {
    const Partial* partial;
    size_t value;
    std::vector<Entry> entries;
  };
  std::vector<Piece> pieces;
  int rows = 0;
  for (const int v : variables) {
    const Derivative::Variable& variable = derivative_.variables[v];
    const Kind kind = variable.kind;
    const int first = matrix == 0 ? offsets_[v] : 0;
    rows = first + system_.tissue().count(kind);
    for (size_t p = 0; p < variable.partials.size(); ++p) {
      Piece& piece = pieces.emplace_back(Piece{&variable.partials[p], value_of_[v][p], {}});
      if (kind == Kind::cell && piece.partial->site == Site::own) {
        for (Index c = 0; c < l.cells; ++c) piece.entries.push_back({first + c, c, c});
        continue;
      }
      for (Index e = 0; e < l.edges; ++e)
        if (stands_for(l, kind, e))
          piece.entries.push_back({first + row_of(kind, e), element(piece.partial->site, e), e});
    }
  }
  // Every column that a row needs, each once.
  const auto for_each = [&](const Piece& piece, auto&& visit) {
    const int v = piece.partial->variable;
    if (v < derivative_.states) {
      for (const Entry& entry : piece.entries) visit(entry.row, offsets_[v] + entry.element);
      return;
    }
    const SparseRows& inner = matrices_[matrix_of_[v]];
    for (const Entry& entry : piece.entries)
      for (int32_t k = inner.begin[entry.element]; k < inner.begin[entry.element + 1]; ++k)
        visit(entry.row, inner.column[k]);
  };
  SparseRows& m = matrices_[matrix];
  std::vector<std::vector<int32_t>> needed(rows);
  for (const Piece& piece : pieces) for_each(piece, [&](int32_t row, int32_t col) { needed[row].push_back(col); });
  if (matrix == 0)
    for (int32_t row = 0; row < rows; ++row) needed[row].push_back(row);  // implicit methods add to the diagonal
  m.begin.assign(1, 0);
  for (std::vector<int32_t>& columns : needed) {
    std::sort(columns.begin(), columns.end());
    columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
    m.column.insert(m.column.end(), columns.begin(), columns.end());
    m.begin.push_back(static_cast<int32_t>(m.column.size()));
  }
  m.value.assign(m.column.size(), 0.0);

  Filling& filling = fillings_[matrix];
  std::vector<uint8_t> touched(m.value.size(), 0);
  const auto touch = [&](int32_t place) { touched[place] = std::min(2, touched[place] + 1); };
  for (const Piece& piece : pieces) {
    std::vector<int32_t> places, source, row;
    for_each(piece, [&](int32_t r, int32_t col) { places.push_back(m.place(r, col)), touch(places.back()); });
    bool in_order = true;
    for (size_t k = 0; k < piece.entries.size(); ++k) in_order &= piece.entries[k].source == static_cast<int32_t>(k);
    for (const Entry& entry : piece.entries) source.push_back(entry.source), row.push_back(entry.element);
    const int v = piece.partial->variable;
    if (v < derivative_.states)
      filling.blocks.push_back(
          {.value = piece.value, .place = places, .source = in_order ? std::vector<int32_t>{} : source});
    else
      filling.products.push_back({piece.value, matrix_of_[v], source, row, places});
  }
  for (size_t k = 0; k < touched.size(); ++k)
    if (touched[k] > 1) filling.shared.push_back(static_cast<int32_t>(k));
  for (Block& block : filling.blocks)
    block.alone = std::none_of(block.place.begin(), block.place.end(), [&](int32_t p) { return touched[p] > 1; });
  // Products add, so their places begin at zero.
  for (const Product& product : filling.products)
    for (const int32_t p : product.place)
      if (touched[p] == 1) filling.shared.push_back(p);
}

// === Values

void Jacobian::fill(int matrix) {
  Filling& filling = fillings_[matrix];
  double* out = matrices_[matrix].value.data();
  for (const int32_t place : filling.shared) out[place] = 0;
  for (Block& block : filling.blocks) {
    const System::Values values = system_.values(block.value);
    const size_t n = block.place.size();
    const int32_t* place = block.place.data();
    if (values.per == System::Values::Per::all) {
      const double number = *values.data;
      if (block.alone && block.written && block.last == number) continue;
      block.last = number, block.written = true;
      for (size_t k = 0; k < n; ++k) block.alone ? out[place[k]] = number : out[place[k]] += number;
    } else if (block.source.empty() && block.alone) {
      for (size_t k = 0; k < n; ++k) out[place[k]] = values.data[k];
    } else {
      for (size_t k = 0; k < n; ++k) {
        const double number = values.data[block.source.empty() ? k : block.source[k]];
        block.alone ? out[place[k]] = number : out[place[k]] += number;
      }
    }
  }
  for (const Product& product : filling.products) {
    const System::Values values = system_.values(product.value);
    const SparseRows& inner = matrices_[product.matrix];
    const int32_t* place = product.place.data();
    const bool same = values.per == System::Values::Per::all;
    for (size_t k = 0; k < product.row.size(); ++k) {
      const double factor = values.data[same ? 0 : product.source[k]];
      const int32_t row = product.row[k];
      for (int32_t j = inner.begin[row]; j < inner.begin[row + 1]; ++j) out[*place++] += factor * inner.value[j];
    }
  }
}

void Jacobian::evaluate_partials(double t, const double* y) { system_.compute_values(t, y); }

void Jacobian::evaluate(double t, const double* y) {
  ++evaluations_;
  if (differences_) return differences_->evaluate(t, y, matrices_[0]);
  system_.compute_values(t, y);
  for (size_t k = 1; k < matrices_.size(); ++k) fill(static_cast<int>(k));
  fill(0);
}

void Jacobian::gather(const double* padded, double* compact) const {
  for (size_t k = 0; k < system_.state().size(); ++k) {
    const System::StateColumn& s = system_.state()[k];
    std::memcpy(compact + offsets_[k], padded + s.offset, sizeof(double) * s.count);
  }
}

void Jacobian::scatter(const double* compact, double* padded) const {
  for (size_t k = 0; k < system_.state().size(); ++k) {
    const System::StateColumn& s = system_.state()[k];
    std::memcpy(padded + s.offset, compact + offsets_[k], sizeof(double) * s.count);
  }
}

}  // namespace tunica
