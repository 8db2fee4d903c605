// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orca::graph {

// Returns what is wrong with a name such as "Platforms/Dewey/base", in words; nothing if it is valid.
std::optional<std::string> name_fault(std::string_view name);

// Returns the names in "a b, c;d". Names contain none of the separators, so people may use any of them.
std::vector<std::string> split_names(std::string_view text);

// Returns the parts of "a;b c; d", without the blanks around them; no parts for a blank text.
std::vector<std::string> split_list(std::string_view text);

}  // namespace orca::graph
