// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "problem.hpp"

namespace orca::text {

// Returns any bytes as characters that XML can hold. A backslash becomes \\. A byte that is part of no XML
// character (control characters, broken UTF-8) becomes \x and two hexadecimal digits.
[[nodiscard]] std::string with_backslashes(std::string_view bytes);

// Reads the bytes back from what with_backslashes() wrote.
[[nodiscard]] Verdict without_backslashes(std::string_view text, std::string& bytes);

}  // namespace orca::text
