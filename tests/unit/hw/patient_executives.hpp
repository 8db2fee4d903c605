// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <vector>

#include "executives.hpp"

namespace orca::test {

/// Returns the executives for cases that wait half a second or more: those with a virtual clock, and all of them in the slow
/// tests, which set ORCA_SLOW.
inline std::vector<ExecutiveOptions> patient_executives() {
  return std::getenv("ORCA_SLOW") != nullptr ? all_executives() : virtual_executives();
}

}  // namespace orca::test
