// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/xml/quantity.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "orca/xml/attributes.hpp"
#include "orca/xml/number.hpp"

namespace orca::xml {
namespace {

// A unit: value in SI = value * multiply / divide. There are two numbers, because 190 mm is exactly 190 /
// 1000 m, but not 190 * 0.001.
struct Unit {
  std::string_view name;
  std::string_view si;  // what it measures, by its SI unit; empty: a ratio
  double multiply = 1.0;
  double divide = 1.0;
};

constexpr double kPi = std::numbers::pi;

constexpr std::array kUnits{
    Unit{"m", "m", 1, 1},
    Unit{"mm", "m", 1, 1000},
    Unit{"cm", "m", 1, 100},
    Unit{"km", "m", 1000, 1},
    Unit{"rad", "rad", 1, 1},
    Unit{"deg", "rad", kPi, 180},
    Unit{"s", "s", 1, 1},
    Unit{"ms", "s", 1, 1000},
    Unit{"us", "s", 1, 1'000'000},
    Unit{"ns", "s", 1, 1'000'000'000},
    Unit{"min", "s", 60, 1},
    Unit{"h", "s", 3600, 1},
    Unit{"Hz", "Hz", 1, 1},
    Unit{"kHz", "Hz", 1000, 1},
    Unit{"m/s", "m/s", 1, 1},
    Unit{"mm/s", "m/s", 1, 1000},
    Unit{"cm/s", "m/s", 1, 100},
    Unit{"km/h", "m/s", 1000, 3600},
    Unit{"rad/s", "rad/s", 1, 1},
    Unit{"deg/s", "rad/s", kPi, 180},
    Unit{"m/s2", "m/s2", 1, 1},
    Unit{"mm/s2", "m/s2", 1, 1000},
    Unit{"cm/s2", "m/s2", 1, 100},
    Unit{"rad/s2", "rad/s2", 1, 1},
    Unit{"deg/s2", "rad/s2", kPi, 180},
    Unit{"kg", "kg", 1, 1},
    Unit{"g", "kg", 1, 1000},
    Unit{"N", "N", 1, 1},
    Unit{"Nm", "Nm", 1, 1},
    Unit{"V", "V", 1, 1},
    Unit{"mV", "V", 1, 1000},
    Unit{"A", "A", 1, 1},
    Unit{"mA", "A", 1, 1000},
    Unit{"B", "B", 1, 1},
    Unit{"kB", "B", 1000, 1},
    Unit{"MB", "B", 1'000'000, 1},
    Unit{"GB", "B", 1'000'000'000, 1},
    Unit{"KiB", "B", 1024, 1},
    Unit{"MiB", "B", 1024.0 * 1024, 1},
    Unit{"GiB", "B", 1024.0 * 1024 * 1024, 1},
    Unit{"%", "", 1, 100},
};

struct Quantity {
  std::string_view si;
  std::string_view name;
};

constexpr std::array kQuantities{
    Quantity{"m", "a length"},
    Quantity{"rad", "an angle"},
    Quantity{"s", "a time"},
    Quantity{"Hz", "a rate"},
    Quantity{"m/s", "a speed"},
    Quantity{"rad/s", "a turn rate"},
    Quantity{"m/s2", "an acceleration"},
    Quantity{"rad/s2", "an angular acceleration"},
    Quantity{"kg", "a mass"},
    Quantity{"N", "a force"},
    Quantity{"Nm", "a torque"},
    Quantity{"V", "a voltage"},
    Quantity{"A", "a current"},
    Quantity{"B", "an amount of memory"},
    Quantity{"", "a plain number"},
};

// Returns the unit called `name`, or null.
const Unit* find_unit(std::string_view name) {
  for (const Unit& unit : kUnits)
    if (unit.name == name) return &unit;
  return nullptr;
}

// Returns "a length", "an angle", ... for the SI unit; empty if Orca does not know the unit.
std::string_view quantity_name(std::string_view si) {
  for (const Quantity& quantity : kQuantities)
    if (quantity.si == si) return quantity.name;
  return {};
}

// Returns the units that may be written where `si` is expected: "m, mm, cm or km".
std::string units_for(std::string_view si) {
  const std::vector<std::string_view> names = units_of(si);
  std::string result(names.front());
  for (std::size_t i = 1; i < names.size(); ++i) {
    result += (i + 1 == names.size() ? " or " : ", ");
    result += names[i];
  }
  return result;
}

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

std::vector<std::string_view> units_of(std::string_view si) {
  std::vector<std::string_view> names;
  for (const Unit& unit : kUnits)
    if (unit.si == si) names.push_back(unit.name);
  if (names.empty()) names.push_back(si);
  return names;
}

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
