// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "executives.hpp"
#include "slow_run.hpp"

namespace orca::test {

/// Runs `body` on the executives for cases that wait half a second or more: those with a virtual clock, and all of them in the slow
/// tests.
inline void on_patient_executives(const std::function<void(Executive&)>& body) {
  run_on_each(is_slow_run() ? all_executives() : virtual_executives(), body);
}

}  // namespace orca::test

/// As EXECUTIVE_CASE, for those.
#define PATIENT_CASE(title, tags) \
  CASE_IN(orca::test::on_patient_executives, (orca::Executive & executive), title, tags)
