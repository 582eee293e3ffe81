// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/aligned.h"
#include "base/cancel.h"
#include "rule/kernels.h"
#include "rule/layout.h"
#include "rule/plan.h"

namespace tunica {

struct SystemOptions {
  InstructionSet set = InstructionSet::best;
  int threads = 1;  ///< the bits do not depend on it
  const CancelFlag* cancel = nullptr;
};

/// The equations bound to a tissue: evaluates derivatives of the state. The state is one vector: the state columns
/// (those that have a rate) one after another, each padded to whole blocks.
class System {
 public:
  System(std::shared_ptr<Equations> equations, std::shared_ptr<Tissue> tissue, SystemOptions options = {});
  ~System();

  struct StateColumn {
    int column;  ///< slot in Equations::columns
    Kind kind;
    std::string name;
    size_t offset;  ///< into the state vector
    Index count;
  };
  const std::vector<StateColumn>& state() const { return state_; }
  size_t state_size() const { return state_size_; }

  /// To be called after anything outside changed: structure, geometry, columns, parameters. Rebuilds only what is
  /// stale. `parameters`: one value per Equations::parameters.
  void prepare(const std::vector<double>& parameters);

  void read_state(double* y) const;         ///< from the tissue's columns
  void write_state(const double* y) const;  ///< to the tissue's columns

  /// dy/dt at time t. Errors: Cancelled between passes; whatever a direct rule throws.
  void rates(double t, const double* y, double* dydt);

  /// y_new = y + h dy/dt in the same sweep. Returns, per state column, whether a result is not finite or negative.
  const std::vector<uint8_t>& euler(double t, const double* y, double h, double* y_new);

  /// Writes all derived columns of the tissue for state y.
  void derive(double t, const double* y);

  /// Further values to be computed from a state (the entries of a Jacobian): nodes of the equations' graph.
  void add_values(const std::vector<NodeId>& nodes);
  /// Computes them; they stay until the next prepare() or compute_values().
  void compute_values(double t, const double* y);
  /// The k-th of them: one per cell, one per half-edge in the layout's order, or one number for all.
  struct Values {
    enum class Per : uint8_t { all, cell, edge } per;
    const double* data;
  };
  Values values(size_t k) const;
  const Layout& layout() const { return *layout_; }

  Equations& equations() { return *equations_; }
  /// Heeds another flag from now on, or none; returns the one before.
  const CancelFlag* heed(const CancelFlag* flag) { return std::exchange(options_.cancel, flag); }

  const Equations& equations() const { return *equations_; }
  Tissue& tissue() { return *tissue_; }
  const Tissue& tissue() const { return *tissue_; }
  const Plan& plan() const { return main_.plan; }
  uint64_t evaluations() const { return evaluations_; }

 private:
  struct Compiled {
    Plan plan;
    std::vector<std::array<int, 3>> scalar_operands;  ///< of each scalar: places of its operands among them, or -1
    std::vector<std::vector<struct Bound>> bound;     ///< per pass
    std::vector<AlignedBuffer> rows;
    AlignedBuffer cell_temps, edge_temps, wall_temps;
    std::vector<double> scalars;
  };
  struct Sweep;  // one evaluation in progress: see sweep.cpp
  struct Stage {
    Compiled compiled;
    int direct = -1;  ///< direct derivation to run after, or -1
  };

  Compiled compile(const std::vector<Output>& outputs);
  void allocate(Compiled& compiled);
  void run_fixed(Compiled& compiled);
  void run(Compiled& compiled, double t, const double* y, double* dydt, double h, double* y_new);
  void run_stages(double t, const double* y);
  void add_direct_rates(double t, double* dydt);
  bool has_direct() const;
  size_t padded(Kind kind) const;

  std::shared_ptr<Equations> equations_;
  std::shared_ptr<Tissue> tissue_;
  SystemOptions options_;
  const Kernels& kernels_;
  std::vector<StateColumn> state_;
  std::vector<int> state_of_column_;  ///< index into state_, or -1
  size_t state_size_ = 0;
  bool cells_only_ = false;  ///< all rates are traced ones of cells: each is written whole, whatever was there
  std::unique_ptr<Layout> layout_;
  std::vector<std::vector<int32_t>> wall_indices_;  ///< own, across, wall, side, mirror per wall, when needed
  uint64_t topology_version_ = 0;
  std::vector<double> parameters_;
  std::vector<Stage> stages_;          ///< derived columns, cut where a direct rule derives; the last without
  Compiled main_;                      ///< rates
  Compiled values_;                    ///< what add_values() asked for
  const double* values_of_ = nullptr;  ///< the state that values() speaks of
  std::vector<uint8_t> flags_;
  std::vector<AlignedBuffer> registers_;  ///< per thread
  AlignedBuffer side_rates_, direct_rates_;
  uint64_t evaluations_ = 0;
};

}  // namespace tunica
