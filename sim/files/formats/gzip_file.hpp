// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/base/result.hpp"

namespace orca::sim::detail {

// Returns the whole text of a file, unpacked if gzip has packed it.
// @errors  not_found: it cannot be opened; data_loss: it is empty, damaged or cut short; invalid_argument: it
//          holds more than 64 MB.
[[nodiscard]] Result<std::string> read_maybe_packed(const std::string& path);

}  // namespace orca::sim::detail
