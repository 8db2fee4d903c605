// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>

#include "orca/base/result.hpp"
#include "orca/batch/statistics/summary.hpp"

namespace orca::batch {

/// Returns an error if there are no values, or if one is not finite or beyond 1e300, so that no sum overflows.
[[nodiscard]] Status check_values(std::span<const double> values);

/// Returns an error if there is no world, or one whose values check_values() refuses.
[[nodiscard]] Status check_worlds(ValuesByWorld worlds);

/// Returns an error if there are not as many worlds in both, or if check_worlds() refuses one of them.
[[nodiscard]] Status check_same_worlds(ValuesByWorld first, ValuesByWorld second);

/// Returns first - second, pair by pair, or an error if the lists differ in length.
[[nodiscard]] Result<std::vector<double>> differences_of(std::span<const double> first,
                                                         std::span<const double> second);

}  // namespace orca::batch
