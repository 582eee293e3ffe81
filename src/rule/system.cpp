// SPDX-License-Identifier: MIT
#include "rule/system.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "rule/sweep.h"

namespace tunica {

System::System(std::shared_ptr<Equations> equations, std::shared_ptr<Tissue> tissue, SystemOptions options)
    : equations_(std::move(equations)),
      tissue_(std::move(tissue)),
      options_(options),
      kernels_(tunica::kernels(options.set)) {
  Equations& e = *equations_;
  std::vector<int> slots;
  for (const Target& rate : e.rates) slots.push_back(rate.column);
  for (const DirectRule& rule : e.direct_rates) slots.insert(slots.end(), rule.columns.begin(), rule.columns.end());
  std::sort(slots.begin(), slots.end());
  slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
  for (const int slot : slots) state_.push_back({slot, e.columns[slot].kind, e.columns[slot].name, 0, 0});
  state_of_column_.assign(e.columns.size(), -1);
  for (size_t k = 0; k < state_.size(); ++k) state_of_column_[state_[k].column] = static_cast<int>(k);
  flags_.resize(state_.size());
  registers_.resize(static_cast<size_t>(std::max(1, options_.threads)));

  std::vector<Output> derived;
  for (const Equations::Derivation& d : e.derivations) {
    for (const Target& target : d.traced) derived.push_back({target.column, target.value, false});
    if (d.direct < 0 && !d.materialise) continue;
    stages_.push_back({compile(derived), d.direct});
    derived.clear();
  }
  stages_.push_back({compile(derived), -1});

  std::vector<Output> rates;
  for (const Target& rate : e.rates) {
    const auto same =
        std::find_if(rates.begin(), rates.end(), [&](const Output& o) { return o.column == rate.column; });
    if (same == rates.end())
      rates.push_back({rate.column, rate.value, true});
    else
      same->value = e.graph.binary(Op::add, same->value, rate.value);
  }
  main_ = compile(rates);
  cells_only_ = !has_direct();
  for (const StateColumn& s : state_) cells_only_ = cells_only_ && s.kind == Kind::cell;
}

System::~System() = default;

System::Compiled System::compile(const std::vector<Output>& outputs) {
  std::vector<bool> changes(equations_->columns.size(), false);
  for (const StateColumn& s : state_) changes[s.column] = true;
  for (const DirectRule& rule : equations_->direct_derivations)
    for (const int column : rule.columns) changes[column] = true;
  for (const Equations::Derivation& d : equations_->derivations)
    for (const Target& target : d.traced) changes[target.column] = true;
  Compiled compiled;
  compiled.plan = lower(*equations_, outputs, changes);
  const std::vector<NodeId>& scalars = compiled.plan.scalars;
  for (const NodeId id : scalars) {
    const Node& n = equations_->graph[id];
    const auto place = [&](NodeId x) {
      return x == no_node ? -1 : static_cast<int>(std::find(scalars.begin(), scalars.end(), x) - scalars.begin());
    };
    compiled.scalar_operands.push_back({place(n.a), place(n.b), place(n.c)});
  }
  return compiled;
}

/// Whether something must be in the tissue's columns before the rates can be computed.
bool System::has_direct() const {
  const Equations& e = *equations_;
  return !e.direct_derivations.empty() || !e.direct_rates.empty() ||
         std::any_of(e.derivations.begin(), e.derivations.end(),
                     [](const Equations::Derivation& d) { return d.materialise; });
}

size_t System::padded(Kind kind) const { return padded_to_blocks(tissue_->count(kind)); }

void System::allocate(Compiled& c) {
  const size_t cells = padded(Kind::cell);
  c.rows.resize(c.plan.row_width.size());
  for (size_t r = 0; r < c.rows.size(); ++r) c.rows[r].resize(cells * c.plan.row_width[r]);
  c.cell_temps.resize(cells * c.plan.cell_temps);
  c.edge_temps.resize(static_cast<size_t>(padded_to_blocks(layout_->edges)) * c.plan.edge_temps);
  c.wall_temps.resize(static_cast<size_t>(layout_->wall_stride) * c.plan.wall_temps);
  c.scalars.assign(c.plan.scalars.size(), 0.0);
}

void System::run_fixed(Compiled& c) {
  Sweep sweep{*this, c, 0, nullptr, nullptr, 0, nullptr};
  sweep.run_fixed();
  sweep.bind();
}

void System::prepare(const std::vector<double>& parameters) {
  parameters_ = parameters;
  std::vector<Compiled*> all{&main_, &values_};
  for (Stage& stage : stages_) all.push_back(&stage.compiled);
  if (topology_version_ != tissue_->topology_version()) {
    topology_version_ = tissue_->topology_version();
    layout_ = std::make_unique<Layout>(*tissue_);
    const Layout& l = *layout_;
    wall_indices_.clear();
    for (const auto* list : {&l.own, &l.across, &l.wall, &l.side, &l.mirror}) {
      std::vector<int32_t>& walls = wall_indices_.emplace_back(l.walls);
      for (Index w = 0; w < l.walls; ++w) walls[w] = (*list)[l.primary[w]];
    }
    state_size_ = 0;
    for (StateColumn& s : state_) {
      s.offset = state_size_;
      s.count = tissue_->count(s.kind);
      state_size_ += padded(s.kind);
    }
    for (Compiled* c : all) allocate(*c);
    side_rates_.resize(state_size_);
    direct_rates_.resize(equations_->direct_rates.empty() ? 0 : state_size_);
  }
  for (Compiled* c : all) run_fixed(*c);
}

void System::read_state(double* y) const {
  for (const StateColumn& s : state_)
    std::memcpy(y + s.offset, tissue_->column(s.kind, s.name).values.data(), sizeof(double) * s.count);
}

void System::write_state(const double* y) const {
  for (const StateColumn& s : state_)
    std::memcpy(tissue_->column(s.kind, s.name).values.data(), y + s.offset, sizeof(double) * s.count);
}

void System::run(Compiled& c, double t, const double* y, double* dydt, double h, double* y_new) {
  Sweep{*this, c, t, y, dydt, h, y_new}.run();
}

void System::run_stages(double t, const double* y) {
  for (Stage& stage : stages_) {
    run(stage.compiled, t, y, nullptr, 0, nullptr);
    if (stage.direct >= 0) equations_->direct_derivations[stage.direct].evaluate(t, {});
  }
}

void System::derive(double t, const double* y) {
  write_state(y);
  run_stages(t, y);
}

void System::add_direct_rates(double t, double* dydt) {
  for (const DirectRule& rule : equations_->direct_rates) {
    std::vector<double*> rates;
    for (const int column : rule.columns) rates.push_back(dydt + state_[state_of_column_[column]].offset);
    rule.evaluate(t, rates);
  }
}

void System::rates(double t, const double* y, double* dydt) {
  ++evaluations_;
  if (has_direct()) derive(t, y);
  if (!cells_only_) std::fill_n(dydt, state_size_, 0.0);  // sides of the border and direct rules leave gaps
  run(main_, t, y, dydt, 0, nullptr);
  add_direct_rates(t, dydt);
  // Kernels work in whole rounds; what they leave beyond the last element must not come back as state.
  for (const StateColumn& s : state_) std::fill_n(dydt + s.offset + s.count, 16, 0.0);
}

void System::add_values(const std::vector<NodeId>& nodes) {
  std::vector<Output> outputs;
  for (const NodeId id : nodes) outputs.push_back({-1, id, false});
  values_ = compile(outputs);
  if (topology_version_ == 0) return;  // prepare() is still to come
  allocate(values_);
  run_fixed(values_);
}

void System::compute_values(double t, const double* y) {
  if (has_direct()) derive(t, y);
  run(values_, t, y, nullptr, 0, nullptr);
  values_of_ = y;
}

System::Values System::values(size_t k) const {
  const Operand& o = values_.plan.values.at(k);
  const auto part = [&](const AlignedBuffer& buffer, int parts) {
    return buffer.data() + buffer.size() / parts * o.index;
  };
  switch (o.place) {
    case Storage::scalar:
      return {Values::Per::all, values_.scalars.data() + o.index};
    case Storage::cell_temp:
      return {Values::Per::cell, part(values_.cell_temps, values_.plan.cell_temps)};
    case Storage::edge_temp:
      return {Values::Per::edge, part(values_.edge_temps, values_.plan.edge_temps)};
    case Storage::column: {
      if (o.index < 0) return {Values::Per::cell, layout_->neighbour_count.data()};
      const int state = state_of_column_[o.index];
      if (state >= 0) return {Values::Per::cell, values_of_ + state_[state].offset};
      const Equations::ColumnRef& ref = equations_->columns[o.index];
      return {Values::Per::cell, tissue_->column(ref.kind, ref.name).values.data()};
    }
    default:
      fail("internal: a value that was not kept");
  }
}

const std::vector<uint8_t>& System::euler(double t, const double* y, double h, double* y_new) {
  std::fill(flags_.begin(), flags_.end(), 0);
  if (cells_only_) {
    ++evaluations_;
    run(main_, t, y, nullptr, h, y_new);
    return flags_;
  }
  double* dydt = side_rates_.data();
  rates(t, y, dydt);
  for (size_t k = 0; k < state_.size(); ++k)
    flags_[k] = kernels_.advance(
        {y + state_[k].offset, dydt + state_[k].offset, 0, h, y_new + state_[k].offset, state_[k].count});
  return flags_;
}

}  // namespace tunica
