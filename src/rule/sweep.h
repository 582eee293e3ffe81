// SPDX-License-Identifier: MIT
#pragma once

#include "rule/system.h"

namespace tunica {

/// An operand as an address: the values of a block are at `at(first element, ...)`.
struct Address {
  enum class Base : uint8_t { nowhere, memory, state, registers } base = Base::nowhere;
  double* memory = nullptr;  ///< first element
  size_t offset = 0;         ///< into the state vector, or the registers
  const double* scalar = nullptr;
};

/// An instruction whose operands are addresses; good until the next prepare().
struct Bound {
  const Instruction* instruction;
  void (*kernel)(const Operands&) = nullptr;
  Address dst, a, b, c;
  std::vector<Address> values, sources;
  Address source;  ///< fetch: the column; gather: the weights
  const int32_t* index = nullptr;
  uint32_t difference = 0;
  int state = -1;  ///< of the column whose rate is given
};

/// One evaluation of a plan: every pass block by block.
struct System::Sweep {
  System& system;
  Compiled& compiled;
  double t;
  const double* y;
  double* dydt;  ///< null in an Euler sweep
  double h;
  double* y_new;  ///< null when derivatives are asked for

  void run();
  void run_fixed();
  void bind();  ///< fills compiled.bound

 private:
  void scalars();
  void pass(const Pass& pass, const std::vector<Bound>& code);
  void work(const Pass& pass, const std::vector<Bound>& code, Index from, Index to, double* registers,
            uint8_t* flags) const;
  Bound bind(const Instruction& i, Pass::Over over) const;
  Address address(const Operand& o) const;
  Address column(int slot) const;
  double* column_to_write(int slot) const;
  const int32_t* index(Code code, Pass::Over over) const;
  double* at(const Address& a, Index first, double* registers) const;
  void cells(const std::vector<Bound>& code, Index block, double* registers, uint8_t* flags) const;
  void sides(const std::vector<Bound>& code, Index first, Index count, double* registers) const;
  void rate(const Bound& b, Index first, Index count, double* registers, uint8_t* flags) const;
};

}  // namespace tunica
