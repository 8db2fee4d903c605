// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string_view>

#include "orca/base/result.hpp"
#include "orca/sim/realism.hpp"

namespace orca::sim {

/// Multiplies single errors of a level, or estimates that all levels share, in order to see how much a result depends on
/// them. An angle grows to 90 degrees at most, a probability or a share to 1.
///
/// @param factors  names of numbers of ErrorLevels with a factor each, from 0 to 100: "slip=2; sonar_noise=0.5". Empty: none.
/// @errors  invalid_argument, with the first word that is wrong and what is expected.
[[nodiscard]] Result<ErrorLevels> scaled(ErrorLevels levels, std::string_view factors);

}  // namespace orca::sim
