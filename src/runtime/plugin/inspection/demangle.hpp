// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace orca::plugin {

/// The name of a symbol as it is written in C++; other names as they are.
[[nodiscard]] std::string demangled(std::string_view symbol);

}  // namespace orca::plugin
