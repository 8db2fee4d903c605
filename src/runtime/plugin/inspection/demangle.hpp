// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace orca::plugin {

/// Returns a symbol's name as it is written in C++, or the name itself if it is not mangled.
[[nodiscard]] std::string demangled(std::string_view symbol);

}  // namespace orca::plugin
