// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "rule/jacobian.h"

namespace tunica {

/// Solves the steady state of linear rates of one cell column on a tissue without cycles:
///   sum over neighbours n of k_cn (y_n - y_c) - m_c y_c + s_c = 0,  k >= 0, m >= 0.
/// Pivots are sums of what is positive: e_i + k_ip with e_i = m_i + sum over children of k_ij e_j / (e_j + k_ji), so
/// that no digits are lost. False if the tissue has cycles or a coefficient has another sign. `source`: the rates at y
/// = 0, per cell. Errors: singular (a piece of the tissue in which nothing decays).
bool solve_tree(const System& system, const Jacobian& jacobian, const double* source, double* y);

}  // namespace tunica
