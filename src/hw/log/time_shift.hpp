// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/time.hpp"
#include "orca/idl/object.hpp"

namespace orca::hw::log_replay {

/// Adds a time to all instants in an object, but to those that are 0, which mean "not known".
void shift_times(ObjectLoan& object, Duration by);

}  // namespace orca::hw::log_replay
