// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "problem.hpp"

namespace orca::text {

// The fewest digits that read_number() takes for the same value. "inf" and "-inf" for the infinite ones.
// "nan" for the NaN that std::numeric_limits has, "nan(7ff8000000000001)", its bits, for any other.
[[nodiscard]] std::string number_text(double value);

// Whether `word` starts as a number does, "nan" and "inf" included.
[[nodiscard]] bool starts_number(std::string_view word);

// A number, with or without a unit behind it.
// `unit`: the SI unit of the field, "1" for a plain number.
[[nodiscard]] Verdict read_number(std::string_view text, std::string_view unit, double& value);

}  // namespace orca::text
