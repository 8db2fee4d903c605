// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"

namespace orca::xml {

/// Converts a value in the unit written behind it to SI.
///
/// @param value    as written.
/// @param written  the unit behind the number, e.g. "mm"; empty: the number is in SI already.
/// @param si       the SI unit that is expected: "m", "rad", "s", "Hz", "m/s", "rad/s", "m/s2", "rad/s2",
///                 "kg", "N", "Nm", "V", "A", and "B" for bytes; empty for a plain number, which may be written
///                 with "%". Any other unit must be written exactly so.
/// @errors  invalid_argument: the unit is unknown or measures something else; says what may be written.
[[nodiscard]] Result<double> to_si(double value, std::string_view written, std::string_view si);

/// Returns the names of the units that may be written where `si` is expected; `si` as in to_si().
[[nodiscard]] std::vector<std::string_view> units_of(std::string_view si);

/// Reads "190 mm", "22.5 deg", "10 Hz" or "0.5" as a value in SI; `si` as in to_si().
/// @errors  as parse_leading_number() and to_si().
[[nodiscard]] Result<double> parse_quantity(std::string_view text, std::string_view si);

/// Takes numbers with blanks between them apart. The last word may be a unit for all: "90 45 deg" is "90 deg" and "45 deg".
[[nodiscard]] std::vector<std::string> split_quantities(std::string_view text);

/// A number in SI and the SI unit of what it measures; empty: a plain number.
struct Measured {
  double value = 0.0;
  std::string si;
};

/// Reads "190 mm", "22.5 deg" or "0.5", whatever it measures.
/// @errors  invalid_argument: no number, a unit that Orca does not know, or a value that is too large in SI.
[[nodiscard]] Result<Measured> parse_measured(std::string_view text);

/// Reads a span of time, "60s", "50 ms", "1.5" (seconds): not negative, at most a hundred years, to the
/// nanosecond.
/// @errors  as parse_quantity(), or invalid_argument with the allowed range.
[[nodiscard]] Result<Duration> parse_duration(std::string_view text);

}  // namespace orca::xml
