// SPDX-License-Identifier: LGPL-3.0-or-later
#include "units.hpp"

#include <array>
#include <numbers>
#include <vector>

namespace orca::xml {
namespace {

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

}  // namespace

const Unit* find_unit(std::string_view name) {
  for (const Unit& unit : kUnits)
    if (unit.name == name) return &unit;
  return nullptr;
}

std::string_view quantity_name(std::string_view si) {
  for (const Quantity& quantity : kQuantities)
    if (quantity.si == si) return quantity.name;
  return {};
}

std::string units_for(std::string_view si) {
  std::vector<std::string_view> names;
  for (const Unit& unit : kUnits)
    if (unit.si == si) names.push_back(unit.name);
  if (names.empty()) return std::string(si);
  std::string result(names.front());
  for (std::size_t i = 1; i < names.size(); ++i) {
    result += (i + 1 == names.size() ? " or " : ", ");
    result += names[i];
  }
  return result;
}

}  // namespace orca::xml
