// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "executives.hpp"
#include "slow_run.hpp"

namespace orca::test {

/// Returns the executives for cases that wait half a second or more: those with a virtual clock, and all of them in the slow
/// tests.
inline std::vector<ExecutiveOptions> patient_executives() {
  return is_slow_run() ? all_executives() : virtual_executives();
}

}  // namespace orca::test
