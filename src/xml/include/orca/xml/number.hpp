// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "orca/base/result.hpp"

namespace orca::xml {

/// Returns `text` without blanks, tabs and line ends at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// The number that a text starts with, and the text after it.
struct LeadingNumber {
  double value = 0.0;
  std::string_view rest;  ///< Trimmed.
};

/// Reads the number at the start of `text`: decimal point, optional exponent, independent of the locale.
/// @errors  invalid_argument with the found text: no digits, "inf" or "nan", too large for a double, or a
///          comma where the point should be (with what to write instead).
[[nodiscard]] Result<LeadingNumber> parse_leading_number(std::string_view text);

/// Reads the whole text as a finite number. Blanks around it are allowed; "10abc", "0x10", "1,5" and "inf"
/// are not.
/// @errors  invalid_argument with the found text and a hint.
[[nodiscard]] Result<double> parse_number(std::string_view text);

/// Reads the whole text as a decimal integer.
/// @errors  invalid_argument: something other than digits, or beyond 64 bits.
[[nodiscard]] Result<std::int64_t> parse_integer(std::string_view text);

/// Returns the shortest text that parse_number() reads back as the same value.
[[nodiscard]] std::string number_text(double value);

}  // namespace orca::xml
