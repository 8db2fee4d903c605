// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "orca/base/result.hpp"

namespace orca::xml {

/// `text` without blanks, tabs and line ends at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// The number a text starts with, and what follows it.
struct LeadingNumber {
  double value = 0.0;
  std::string_view rest;  ///< Trimmed.
};

/// Reads the number at the start of `text`: decimal point, optional exponent, whatever the locale says.
/// @errors  invalid_argument with the found text: no digits, "inf" or "nan", too large for a double, or a
///          comma where the point should be (with what to write instead).
[[nodiscard]] Result<LeadingNumber> parse_leading_number(std::string_view text);

/// The whole text as a finite number. Blanks around it are allowed, "10abc", "0x10", "1,5", "inf" are not.
/// @errors  invalid_argument with the found text and a hint.
[[nodiscard]] Result<double> parse_number(std::string_view text);

/// The whole text as a decimal integer.
/// @errors  invalid_argument: something else than digits, or beyond 64 bits.
[[nodiscard]] Result<std::int64_t> parse_integer(std::string_view text);

/// The shortest text that parse_number() reads back as the same value.
[[nodiscard]] std::string number_text(double value);

}  // namespace orca::xml
