// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "rule/derivative.h"
#include "rule/system.h"

namespace tunica {

/// A sparse matrix by rows; columns of a row ascend.
struct SparseRows {
  std::vector<int32_t> begin, column;  ///< begin: one more than there are rows
  std::vector<double> value;

  int rows() const { return static_cast<int>(begin.size()) - 1; }
  /// Place of an entry among the values. Errors: not in the pattern.
  int32_t place(int row, int32_t col) const;
  /// out = matrix * v
  void multiply(const double* v, double* out) const;
};

/// The exact sparse Jacobian d(rates) / d(state) of traced rules. Unknowns are numbered column of state after column of
/// state, without the padding of the state vector. Derived columns are followed through (second ring of neighbours).
/// If a rule was not traced, the entries are finite differences (differences.h).
class Jacobian {
 public:
  explicit Jacobian(System& system);
  ~Jacobian();

  /// Empty if the rules are traced and the entries exact; else the places of the rules that are not.
  const std::vector<std::string>& missing() const { return derivative_.missing; }
  /// Operations that bend (max, where, ...), with the rules' places.
  const std::vector<std::string>& kinks() const { return derivative_.kinks; }

  /// The rates are linear in the state, but for a constant.
  bool linear() const { return derivative_.linear && derivative_.missing.empty(); }
  const Derivative& derivative() const { return derivative_; }
  /// Values of the last evaluation: of partial p of variable v, and of Derivative::uniform.
  System::Values partial(int v, size_t p) const { return system_.values(value_of_[v][p]); }
  System::Values uniform() const { return system_.values(uniform_value_); }

  /// After System::prepare(): the pattern, if the structure has changed.
  void prepare();
  /// The entries at state y (padded, as System has it).
  void evaluate(double t, const double* y);

  /// The partials alone, without the matrix (and without prepare()).
  void evaluate_partials(double t, const double* y);

  int size() const { return size_; }
  size_t intermediates() const { return derivative_.order.size(); }
  const SparseRows& matrix() const { return matrices_[0]; }
  /// First unknown of each state column, and one more.
  const std::vector<int32_t>& offsets() const { return offsets_; }
  uint64_t evaluations() const { return evaluations_; }
  uint64_t structure() const { return structure_; }  ///< changes when the pattern does

  /// From and to the state vector of System.
  void gather(const double* padded, double* compact) const;
  void scatter(const double* compact, double* padded) const;

 private:
  /// One partial of one variable: where its values go.
  struct Block {
    size_t value;                 ///< in System::values
    std::vector<int32_t> place;   ///< per entry, in the order of its values
    std::vector<int32_t> source;  ///< per entry: which value (walls: only first sides); empty: all in order
    bool alone = false;           ///< no other block adds to its places
    double last = 0;              ///< a number for all: as written
    bool written = false;
  };
  /// A partial by an intermediate: its values times rows of the intermediate's matrix.
  struct Product {
    size_t value;
    int matrix;
    std::vector<int32_t> source, row;  ///< per factor: which value, which row of the matrix
    std::vector<int32_t> place;        ///< per product, in order
  };
  /// What fills one matrix: the state's (0), or an intermediate's.
  struct Filling {
    std::vector<Block> blocks;
    std::vector<Product> products;
    std::vector<int32_t> shared;  ///< places that several add to
  };
  struct Entry;

  void build(int matrix, const std::vector<int>& variables);
  void fill(int matrix);
  int32_t element(Site site, int half_edge) const;
  int32_t row_of(Kind kind, int half_edge) const;

  System& system_;
  Derivative derivative_;
  std::unique_ptr<class Differences> differences_;
  std::vector<int> matrix_of_;                 ///< per variable that is an intermediate
  std::vector<std::vector<size_t>> value_of_;  ///< per variable and partial: in System::values
  size_t uniform_value_ = 0;
  std::vector<SparseRows> matrices_;
  std::vector<Filling> fillings_;
  std::vector<int32_t> offsets_;
  int size_ = 0;
  uint64_t structure_ = 0, evaluations_ = 0;
};

}  // namespace tunica
