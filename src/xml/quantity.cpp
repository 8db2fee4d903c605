// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/xml/quantity.hpp"

#include <cmath>
#include <string>

#include "orca/xml/attributes.hpp"
#include "orca/xml/number.hpp"
#include "units.hpp"

namespace orca::xml {
namespace {

std::string expected(std::string_view si) {
  const std::string name(quantity_name(si));
  if (si.empty()) return name + " is expected: write none, or % for hundredths";
  return (name.empty() ? "a value in " + std::string(si) : name) + " is expected: write " + units_for(si);
}

Error wrong_unit(std::string_view written, std::string_view si, const Unit* found) {
  std::string what = "\"" + std::string(written) + "\" ";
  what += found == nullptr ? "is not a unit that Orca knows"
                           : "measures " + std::string(quantity_name(found->si));
  return fail(Code::invalid_argument, what + "; " + expected(si));
}

}  // namespace

Result<double> to_si(double value, std::string_view written, std::string_view si) {
  if (written.empty() || (written == si && find_unit(si) == nullptr)) return value;
  const Unit* unit = find_unit(written);
  if (unit == nullptr || unit->si != si) return wrong_unit(written, si, unit);
  const double result = value * unit->multiply / unit->divide;
  if (!std::isfinite(result))
    return fail(Code::invalid_argument, "the value is too large in " + std::string(si));
  return result;
}

Result<double> parse_quantity(std::string_view text, std::string_view si) {
  const Result<LeadingNumber> number = parse_leading_number(text);
  if (!number) return number.error();
  const Result<double> value = to_si(number->value, number->rest, si);
  if (!value) return fail(Code::invalid_argument, "\"" + std::string(text) + "\": " + value.error().message);
  return value;
}

std::vector<std::string> split_quantities(std::string_view text) {
  std::vector<std::string_view> pieces = words(text);
  std::string unit;
  if (!pieces.empty() && !parse_number(pieces.back())) {
    unit = " " + std::string(pieces.back());
    pieces.pop_back();
  }
  std::vector<std::string> quantities;
  for (const std::string_view piece : pieces) quantities.push_back(std::string(piece) + unit);
  return quantities;
}

Result<std::vector<double>> parse_quantities(std::string_view text, std::string_view si) {
  std::vector<double> values;
  for (const std::string& piece : split_quantities(text)) {
    const Result<double> value = parse_quantity(piece, si);
    if (!value) return value.error();
    values.push_back(*value);
  }
  return values;
}

Result<Measured> parse_measured(std::string_view text) {
  const Result<LeadingNumber> number = parse_leading_number(text);
  if (!number) return number.error();
  if (number->rest.empty()) return Measured{number->value, {}};
  const Unit* const unit = find_unit(number->rest);
  if (unit == nullptr)
    return fail(Code::invalid_argument, "\"" + std::string(text) + "\": \"" + std::string(number->rest) +
                                            "\" is not a unit that Orca knows");
  const Result<double> value = to_si(number->value, number->rest, unit->si);
  if (!value) return value.error();
  return Measured{*value, std::string(unit->si)};
}

Result<Duration> parse_duration(std::string_view text) {
  constexpr double kLongest = 100.0 * 365.25 * 86400.0;
  const Result<double> seconds = parse_quantity(text, "s");
  if (!seconds) return seconds.error();
  if (*seconds < 0.0 || *seconds > kLongest) {
    return fail(Code::invalid_argument,
                "\"" + std::string(text) + "\" is not between 0 s and a hundred years");
  }
  return from_seconds(*seconds);
}

}  // namespace orca::xml
