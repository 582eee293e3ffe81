// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "rule/graph.h"

namespace tunica {

/// What a rule gives a column: a cell value for a cell column, a side value for a side or wall column (a wall's value
/// is that of its first side).
struct Target {
  int column;  ///< slot in Equations::columns
  NodeId value;
  std::string where;  ///< the rule's place in the script, for messages
};

/// A rule that could not be traced and is evaluated by its host, whole sweeps at a time.
struct DirectRule {
  /// derive: writes its columns of the tissue. rate: adds to `rates`, one value per element of each output column.
  std::function<void(double time, const std::vector<double*>& rates)> evaluate;
  std::vector<int> columns;  ///< outputs
  std::string where;
};

/// The model's equations: traced rules as expression graphs, the rest as direct rules. Written once; every method of
/// solution uses them.
struct Equations {
  struct ColumnRef {
    Kind kind;
    std::string name;
  };
  /// Either the values of derived columns (traced), or one direct rule that derives; in the order declared.
  struct Derivation {
    std::vector<Target> traced;
    int direct = -1;
    bool materialise =
        false;  ///< later rules read the columns, not the expressions (walls, which have two orientations)
  };

  Graph graph;
  std::vector<ColumnRef> columns;
  std::vector<std::string> parameters;
  std::vector<Derivation> derivations;
  std::vector<Target> rates;  ///< d(column)/dt; contributions to one column are added
  std::vector<DirectRule> direct_derivations, direct_rates;

  int column_slot(Kind kind, const std::string& name) {
    for (size_t i = 0; i < columns.size(); ++i)
      if (columns[i].kind == kind && columns[i].name == name) return static_cast<int>(i);
    columns.push_back({kind, name});
    return static_cast<int>(columns.size()) - 1;
  }
  int parameter_slot(const std::string& name) {
    for (size_t i = 0; i < parameters.size(); ++i)
      if (parameters[i] == name) return static_cast<int>(i);
    parameters.push_back(name);
    return static_cast<int>(parameters.size()) - 1;
  }
};

}  // namespace tunica
