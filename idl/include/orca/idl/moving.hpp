// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// MovingThings and Teammate. idl/orca/moving.idl gives the meaning of each field.
#pragma once

#include "orca/base/result.hpp"
#include "orca/idl/generated/moving.h"
#include "orca/idl/generated/moving.types.hpp"
#include "orca/idl/geometry.hpp"
#include "orca/idl/object.hpp"
#include "orca/idl/time.hpp"

namespace orca {

/// Returns whether all its numbers are finite and possible.
/// @errors  invalid_argument that names the first that is not.
/// @thread  pure function; any thread.
[[nodiscard]] Status check_reading(const idl::MovingThings& moving);
/// Returns whether the numbers of its pose and velocity are finite and possible.
/// @errors  invalid_argument that names the first that is not.
/// @thread  pure function; any thread.
[[nodiscard]] Status check_reading(const idl::Teammate& mate);

}  // namespace orca
