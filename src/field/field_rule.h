// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "base/aligned.h"
#include "rule/graph.h"
#include "rule/kernels.h"

namespace tunica {

/// The share of one primordium in an inhibition field: f(distance, age, time).
class FieldRule {
 public:
  virtual ~FieldRule() = default;
  /// h[i] += f(d[i], age, t) for `count` distances (a multiple of 4).
  virtual void add(double age, double t, const double* d, int count, double* h) = 0;
  virtual double at(double d, double age, double t) = 0;
  /// The weight w if f is w(age, t) / d, which is much the cheapest form; else nothing.
  virtual std::optional<double> reciprocal(double /*age*/, double /*t*/) { return {}; }
  /// Values of the parameters that the rule reads.
  virtual void set_parameters(const std::vector<double>&) {}
};

/// A traced rule: a graph in which the column of a side is the distance, the column of a cell the age. What depends on
/// the age alone is computed once per primordium, the rest over blocks of distances.
class TracedField : public FieldRule {
 public:
  /// Errors: the graph reads anything else.
  TracedField(const Graph& graph, NodeId root);
  void add(double age, double t, const double* d, int count, double* h) override;
  double at(double d, double age, double t) override;
  std::optional<double> reciprocal(double age, double t) override;
  void set_parameters(const std::vector<double>& values) override { parameters_ = values; }

 private:
  bool of_pairs(NodeId id) const { return graph_[id].domain == Domain::side && graph_[id].op != Op::own; }
  bool find_reciprocal(NodeId id) const;
  double weight(NodeId id) const;
  double value(NodeId id) const { return values_[static_cast<size_t>(id)]; }
  void prepare(double age, double t);
  double compute(const Node& n) const;

  Graph graph_;
  NodeId root_;
  std::vector<NodeId> single_, pairs_;  ///< nodes by what they depend on, operands first
  std::vector<double> values_;          ///< per node: what depends on the age alone
  std::vector<AlignedBuffer> blocks_;   ///< per node of pairs_
  std::vector<int> block_of_;
  AlignedBuffer distances_;
  std::vector<double> parameters_;
  bool reciprocal_;
};

}  // namespace tunica
