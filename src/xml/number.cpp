// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/xml/number.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "cursor.hpp"

namespace orca::xml {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

Error not_a_number(std::string_view text, const std::string& hint) {
  return fail(Code::invalid_argument, "\"" + std::string(text) + "\" is not a number" + hint);
}

// Returns whether "0,5 m" was meant as "0.5 m": a comma straight after the digits read so far, with a digit
// behind it.
bool comma_follows(std::string_view rest) { return rest.size() > 1 && rest[0] == ',' && is_digit(rest[1]); }

Error comma_error(std::string_view text) {
  std::string fixed(text);
  fixed.replace(fixed.find(','), 1, ".");
  return not_a_number(text, ": write a decimal point, \"" + fixed + "\"");
}

Error trailing_error(std::string_view text, std::string_view rest) {
  return not_a_number(text, ": it stops being one at \"" + std::string(rest) + "\"");
}

// std::from_chars takes no '+', and would take "inf" and "nan", which start with a letter.
std::string_view without_plus(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  return text;
}

bool starts_like_a_number(std::string_view digits) {
  const std::size_t first = digits.find_first_not_of('-');
  return first != std::string_view::npos && (is_digit(digits[first]) || digits[first] == '.');
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

Result<LeadingNumber> parse_leading_number(std::string_view text) {
  const std::string_view digits = without_plus(trimmed(text));
  const char* end = digits.data() + digits.size();
  LeadingNumber result;
  const auto [stop, problem] = std::from_chars(digits.data(), end, result.value);
  if (problem == std::errc::invalid_argument) return not_a_number(text, "");
  if (!starts_like_a_number(digits)) return not_a_number(text, ": it must be finite");
  if (problem == std::errc::result_out_of_range)
    return not_a_number(text, " of 64 bits: it is too large or too small");
  const std::string_view rest(stop, static_cast<std::size_t>(end - stop));
  if (comma_follows(rest)) return comma_error(text);
  result.rest = trimmed(rest);
  return result;
}

Result<double> parse_number(std::string_view text) {
  const Result<LeadingNumber> number = parse_leading_number(text);
  if (!number) return number.error();
  if (!number->rest.empty()) return trailing_error(text, number->rest);
  return number->value;
}

Result<std::int64_t> parse_integer(std::string_view text) {
  const std::string_view digits = without_plus(trimmed(text));
  const char* end = digits.data() + digits.size();
  std::int64_t value = 0;
  const auto [stop, problem] = std::from_chars(digits.data(), end, value);
  if (problem == std::errc{} && stop == end) return value;
  const std::string shown = "\"" + std::string(text) + "\"";
  if (problem == std::errc::result_out_of_range)
    return fail(Code::invalid_argument, shown + " does not fit in 64 bits");
  return fail(Code::invalid_argument, shown + " is not an integer: digits only, no point and no unit");
}

std::string number_text(double value) {
  // Within these bounds people read 100000 and 0.00001 more easily than powers of ten.
  const double size = std::abs(value);
  const bool plain = size == 0.0 || (size >= 1e-6 && size < 1e15);
  const auto format = plain ? std::chars_format::fixed : std::chars_format::scientific;
  std::array<char, 40> buffer{};
  const auto [end, problem] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format);
  return std::string(buffer.data(), end);
}

}  // namespace orca::xml
