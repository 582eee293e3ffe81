// SPDX-License-Identifier: MIT
#include "rule/sweep.h"

#include <algorithm>
#include <cstring>

namespace tunica {

namespace {

constexpr Index worth_threads = 5000;  ///< cells below which a second thread costs more than it brings
constexpr int row_kernel(int width) { return width == 1 ? 0 : width == 2 ? 1 : 2; }

}  // namespace

void System::Sweep::scalars() {
  const Graph& graph = system.equations_->graph;
  std::vector<double>& values = compiled.scalars;
  for (size_t k = 0; k < values.size(); ++k) {
    const Node& n = graph[compiled.plan.scalars[k]];
    const auto& from = compiled.scalar_operands[k];
    const auto value = [&](int which) { return from[which] < 0 ? 0.0 : values[from[which]]; };
    if (n.op == Op::constant)
      values[k] = n.value;
    else if (n.op == Op::parameter)
      values[k] = system.parameters_.at(n.slot);
    else if (n.op == Op::time)
      values[k] = t;
    else
      values[k] = apply(n.op, value(0), value(1), value(2));
  }
}

// === Operands to addresses

Address System::Sweep::column(int slot) const {
  if (slot < 0) return {Address::Base::memory, system.layout_->neighbour_count.data()};
  const int state = system.state_of_column_[slot];
  if (state >= 0) return {Address::Base::state, nullptr, system.state_[state].offset};
  return {Address::Base::memory, column_to_write(slot)};
}

double* System::Sweep::column_to_write(int slot) const {
  const Equations::ColumnRef& ref = system.equations_->columns[slot];
  return system.tissue_->column(ref.kind, ref.name).values.data();
}

Address System::Sweep::address(const Operand& o) const {
  const auto part = [&](AlignedBuffer& buffer, int parts) {
    return Address{Address::Base::memory, buffer.data() + buffer.size() / std::max(1, parts) * o.index};
  };
  switch (o.place) {
    case Storage::nowhere:
      return {};
    case Storage::scalar:
      return {.scalar = compiled.scalars.data() + o.index};
    case Storage::reg:
      return {Address::Base::registers, nullptr, static_cast<size_t>(o.index) * block_size};
    case Storage::column:
      return column(o.index);
    case Storage::cell_temp:
      return part(compiled.cell_temps, compiled.plan.cell_temps);
    case Storage::edge_temp:
      return part(compiled.edge_temps, compiled.plan.edge_temps);
    case Storage::wall_temp:
      return part(compiled.wall_temps, compiled.plan.wall_temps);
  }
  return {};
}

const int32_t* System::Sweep::index(Code code, Pass::Over over) const {
  const int which = code == Code::fetch_own      ? 0
                    : code == Code::fetch_across ? 1
                    : code == Code::fetch_wall   ? 2
                    : code == Code::fetch_side   ? 3
                                                 : 4;
  if (over == Pass::Over::walls) return system.wall_indices_[which].data();
  const Layout& l = *system.layout_;
  const std::vector<int32_t>* lists[] = {&l.own, &l.across, &l.wall, &l.side, &l.mirror};
  return lists[which]->data();
}

Bound System::Sweep::bind(const Instruction& i, Pass::Over over) const {
  Bound b{.instruction = &i};
  b.dst =
      i.dst.place == Storage::column ? Address{Address::Base::memory, column_to_write(i.dst.index)} : address(i.dst);
  b.a = address(i.a);
  b.b = address(i.b);
  b.c = address(i.c);
  for (const Operand& o : i.values) b.values.push_back(address(o));
  for (const Operand& o : i.sources) b.sources.push_back(address(o));
  if (i.code < Code::elementwise_count) {
    const auto scalar = [](const Operand& o) { return o.place == Storage::scalar || o.place == Storage::nowhere; };
    const int mask = (scalar(i.a) ? 1 : 0) | (scalar(i.b) ? 2 : 0) | (scalar(i.c) ? 4 : 0);
    b.kernel = system.kernels_.elementwise[static_cast<int>(i.code)][mask];
  }
  switch (i.code) {
    case Code::gather:
      for (size_t j = 0; j < i.difference.size(); ++j) b.difference |= (i.difference[j] ? 1u : 0u) << j;
      if (i.weight >= 0) b.source = address({Storage::edge_temp, i.weight});
      break;
    case Code::fetch_own:
    case Code::fetch_across:
      b.index = index(i.code, over);
      b.source = b.a;
      break;
    case Code::fetch_wall:
    case Code::fetch_side:
    case Code::fetch_mirrored:
      b.index = index(i.code, over);
      b.source = column(i.column);
      break;
    case Code::scatter:
      b.index = index(over == Pass::Over::edges ? Code::fetch_side : Code::fetch_wall, over);
      b.state = i.is_rate ? system.state_of_column_[i.column] : -1;
      if (!i.is_rate) b.dst = {Address::Base::memory, column_to_write(i.column)};
      break;
    case Code::rate:
      b.state = system.state_of_column_[i.column];
      break;
    default:
      break;
  }
  return b;
}

void System::Sweep::bind() {
  compiled.bound.clear();
  for (const Pass& p : compiled.plan.passes) {
    std::vector<Bound>& code = compiled.bound.emplace_back();
    for (const Instruction& i : p.code) code.push_back(bind(i, p.over));
  }
}

// === Running

double* System::Sweep::at(const Address& a, Index first, double* registers) const {
  switch (a.base) {
    case Address::Base::memory:
      return a.memory + first;
    case Address::Base::state:
      return const_cast<double*>(y) + a.offset + first;
    case Address::Base::registers:
      return registers + a.offset;
    case Address::Base::nowhere:
      break;
  }
  return nullptr;
}

namespace {

double value_of(const Address& a) { return a.scalar ? *a.scalar : 0.0; }

}  // namespace

void System::Sweep::rate(const Bound& b, Index first, Index count, double* registers, uint8_t* flags) const {
  const Kernels& k = system.kernels_;
  const size_t offset = system.state_[b.state].offset + first;
  const double* values = at(b.a, first, registers);
  if (b.instruction->fused) {
    const auto place = [&](const Address& a) { return at(a, first, registers); };
    const Operands o{y_new ? nullptr : dydt + offset,
                     values,
                     place(b.b),
                     place(b.c),
                     value_of(b.a),
                     value_of(b.b),
                     value_of(b.c),
                     count};
    const int mask = (o.a ? 0 : 1) | (o.b ? 0 : 2) | (o.c ? 0 : 4);
    if (y_new)
      flags[b.state] |= k.advance_multiply_add[mask]({y + offset, nullptr, 0, h, y_new + offset, count}, o);
    else
      k.elementwise[static_cast<int>(Code::multiply_add)][mask](o);
  } else if (y_new) {
    flags[b.state] |= k.advance({y + offset, values, value_of(b.a), h, y_new + offset, count});
  } else if (values) {
    std::memcpy(dydt + offset, values, sizeof(double) * count);
  } else {
    std::fill_n(dydt + offset, count, value_of(b.a));
  }
}

void System::Sweep::cells(const std::vector<Bound>& code, Index block, double* registers, uint8_t* flags) const {
  const LayoutView view = system.layout_->view();
  const Index first = block * block_size, count = std::min<Index>(block_size, system.layout_->cells - first);
  const Kernels& k = system.kernels_;
  const auto place = [&](const Address& a) { return at(a, first, registers); };
  for (const Bound& b : code) {
    const Instruction& i = *b.instruction;
    if (b.kernel) {
      b.kernel({place(b.dst), place(b.a), place(b.b), place(b.c), value_of(b.a), value_of(b.b), value_of(b.c), count});
      continue;
    }
    switch (i.code) {
      case Code::pack: {
        const int width = compiled.plan.row_width[i.row];
        const double* values[4] = {};
        for (int j = 0; j < 4; ++j) values[j] = place(b.values[std::min<size_t>(j, b.values.size() - 1)]);
        k.pack[row_kernel(width)](compiled.rows[i.row].data() + static_cast<size_t>(width) * first, values, count);
        break;
      }
      case Code::gather: {
        GatherArguments g{.layout = &view,
                          .block = block,
                          .weights = b.source.memory,
                          .difference = b.difference,
                          .columns = static_cast<int>(b.values.size())};
        for (size_t j = 0; j < b.values.size(); ++j) g.out[j] = place(b.values[j]);
        if (i.row >= 0) {
          g.rows[0] = compiled.rows[i.row].data();
          k.gather[row_kernel(compiled.plan.row_width[i.row])](g);
        } else {
          for (size_t j = 0; j < b.sources.size(); ++j) g.rows[j] = at(b.sources[j], 0, registers);
          b.sources.size() == 1 ? k.gather[0](g) : k.gather_two(g);
        }
        break;
      }
      case Code::edge_sum:
        k.edge_sum(view, block, b.a.memory, place(b.dst));
        break;
      case Code::edge_minimum:
        k.edge_minimum(view, block, b.a.memory, place(b.dst));
        break;
      case Code::edge_maximum:
        k.edge_maximum(view, block, b.a.memory, place(b.dst));
        break;
      case Code::wall_sum:
        k.wall_sum(view, block, b.a.memory, place(b.dst));
        break;
      case Code::rate:
        rate(b, first, count, registers, flags);
        break;
      default:
        fail("internal: instruction {} in a cell pass", static_cast<int>(i.code));
    }
  }
}

void System::Sweep::sides(const std::vector<Bound>& code, Index first, Index count, double* registers) const {
  const auto place = [&](const Address& a) { return at(a, first, registers); };
  for (const Bound& b : code) {
    const Instruction& i = *b.instruction;
    if (b.kernel) {
      b.kernel({place(b.dst), place(b.a), place(b.b), place(b.c), value_of(b.a), value_of(b.b), value_of(b.c), count});
    } else if (i.code == Code::scatter) {
      const double* from = place(b.a);
      double* to = i.is_rate ? dydt + system.state_[b.state].offset : b.dst.memory;
      for (Index e = 0; e < count; ++e) to[b.index[first + e]] = from ? from[e] : value_of(b.a);
    } else {
      system.kernels_.fetch(place(b.dst), at(b.source, 0, registers), b.index + first, count);
    }
  }
}

void System::Sweep::work(const Pass& p, const std::vector<Bound>& code, Index from, Index to, double* registers,
                         uint8_t* flags) const {
  const Layout& l = *system.layout_;
  const Index elements = p.over == Pass::Over::edges ? l.edges : l.walls;
  for (Index block = from; block < to; ++block) {
    if (p.over == Pass::Over::cells)
      cells(code, block, registers, flags);
    else
      sides(code, block * block_size, std::min<Index>(block_size, elements - block * block_size), registers);
  }
}

void System::Sweep::pass(const Pass& p, const std::vector<Bound>& code) {
  const Layout& l = *system.layout_;
  const Index elements = p.over == Pass::Over::cells ? l.cells : p.over == Pass::Over::edges ? l.edges : l.walls;
  const Index blocks = (elements + block_size - 1) / block_size;
  const int threads = l.cells >= worth_threads ? std::min<int>(system.options_.threads, blocks) : 1;
  const size_t registers = static_cast<size_t>(std::max(1, p.registers)) * block_size;
  for (int thread = 0; thread < threads; ++thread)
    if (system.registers_[thread].size() < registers) system.registers_[thread].resize(registers);
  if (threads <= 1) return work(p, code, 0, blocks, system.registers_[0].data(), system.flags_.data());
  std::vector<std::vector<uint8_t>> flags(threads, std::vector<uint8_t>(system.flags_.size(), 0));
#pragma omp parallel for num_threads(threads) schedule(static, 1)
  for (int thread = 0; thread < threads; ++thread)
    work(p, code, static_cast<Index>(static_cast<int64_t>(blocks) * thread / threads),
         static_cast<Index>(static_cast<int64_t>(blocks) * (thread + 1) / threads), system.registers_[thread].data(),
         flags[thread].data());
  for (const auto& found : flags)
    for (size_t k = 0; k < found.size(); ++k) system.flags_[k] |= found[k];
}

void System::Sweep::run() {
  scalars();
  for (size_t k = 0; k < compiled.bound.size(); ++k) {
    poll(system.options_.cancel);
    pass(compiled.plan.passes[k], compiled.bound[k]);
  }
}

void System::Sweep::run_fixed() {
  scalars();
  for (const Pass& p : compiled.plan.once) {
    std::vector<Bound> code;
    for (const Instruction& i : p.code) code.push_back(bind(i, p.over));
    pass(p, code);
  }
}

}  // namespace tunica
