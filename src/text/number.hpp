// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "codes.hpp"

namespace orca::text {

// Returns the fewest digits that read_number() reads as the same value. Infinite values are "inf" and "-inf".
// The NaN of std::numeric_limits is "nan"; any other is shown with its bits: "nan(7ff8000000000001)".
[[nodiscard]] std::string number_text(double value);

// Returns whether `word` starts like a number, including "nan" and "inf".
[[nodiscard]] bool starts_number(std::string_view word);

// Reads a number, with or without a unit after it. `unit` is the SI unit of the field, or "1" for a plain
// number.
[[nodiscard]] Verdict read_number(std::string_view text, std::string_view unit, double& value);

// Returns an instant in seconds, exact to the nanosecond: "12.05".
[[nodiscard]] std::string instant_text(std::int64_t ns);

// Reads an instant: "12.05", "12.05 s" and "-0.000000001" exactly; "50 ms" and "1e3 s" to the nearest
// nanosecond.
[[nodiscard]] Verdict read_instant(std::string_view text, std::int64_t& ns);

}  // namespace orca::text
