// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/robots/values.hpp"

namespace orca::sim::detail {

using namespace robots::values;

}  // namespace orca::sim::detail
