// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

namespace orca {

/// Describes the exception being handled, whatever its type: "threw std::runtime_error: no echo", "threw the
/// int 42". The text is a copy, so it outlives the plugin that threw.
///
/// @pre  called from inside a catch block.
[[nodiscard]] std::string describe_current_exception();

}  // namespace orca
