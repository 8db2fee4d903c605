// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/time.hpp"
#include "orca/idl/object.hpp"

namespace orca {

/// Adds a time [s] to all instants in an object, also of types that are not Orca's own, but not to those that are 0, which mean
/// "not known".
/// @thread  that of the object.
void shift_times(ObjectLoan& object, Duration by);

}  // namespace orca
