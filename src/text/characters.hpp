// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "problem.hpp"

namespace orca::text {

// Any bytes as characters that XML can hold: a backslash becomes \\, each byte that is part of no character
// of XML (control characters, broken UTF-8) becomes \x and two hexadecimal digits.
[[nodiscard]] std::string with_backslashes(std::string_view bytes);

// The way back.
[[nodiscard]] Verdict without_backslashes(std::string_view text, std::string& bytes);

}  // namespace orca::text
