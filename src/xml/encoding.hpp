// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "orca/xml/diagnostics.hpp"

namespace orca::xml {

// Returns the text that can be scanned: UTF-8 without control characters and without a byte order mark.
// Anything else is reported. If only a byte order mark is wrong, it is cut off, so that the other errors of
// the file can be reported as well.
std::optional<std::string_view> checked_text(std::string_view bytes, const std::string& file,
                                             Diagnostics& out);

}  // namespace orca::xml
