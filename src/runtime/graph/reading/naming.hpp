// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orca::graph {

// What is wrong with a name such as "Platforms/Dewey/base", in words; nothing if it is a good one.
std::optional<std::string> name_fault(std::string_view name);

// The names in "a b, c;d": names hold none of the separators, so people may use the one they like.
std::vector<std::string> split_names(std::string_view text);

// The parts of "a;b c; d", without the blanks around them; no parts in a blank text.
std::vector<std::string> split_list(std::string_view text);

}  // namespace orca::graph
