// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::batch {

/// Returns p-values adjusted for their number by Holm's step-down method, in the order given. Comparing them with 0.05 keeps
/// the probability of any false finding among all of them at 5 %, whatever their dependence. The i-th smallest of m values
/// becomes the largest of min(1, (m - j + 1) p_j) over j <= i. An empty list gives an empty list.
///
/// @param p_values  in [0, 1], in any order: those of all tests that were made, not only of the ones that are reported.
/// @errors  invalid_argument if a value is not in [0, 1], or not a number.
/// @thread  a pure function; any thread.
/// @source  Holm, "A simple sequentially rejective multiple test procedure", Scandinavian Journal of Statistics 6, 1979.
[[nodiscard]] Result<std::vector<double>> holm(std::span<const double> p_values);

}  // namespace orca::batch
