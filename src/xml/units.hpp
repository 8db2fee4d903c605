// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace orca::xml {

// A unit: value in SI = value * multiply / divide. There are two numbers, because 190 mm is exactly 190 /
// 1000 m, but not 190 * 0.001.
struct Unit {
  std::string_view name;
  std::string_view si;  // what it measures, by its SI unit; empty: a ratio
  double multiply = 1.0;
  double divide = 1.0;
};

// Returns the unit called `name`, or null.
const Unit* find_unit(std::string_view name);

// Returns "a length", "an angle", ... for the SI unit; empty if Orca does not know the unit.
std::string_view quantity_name(std::string_view si);

// Returns the units that may be written where `si` is expected: "m, mm, cm or km".
std::string units_for(std::string_view si);

}  // namespace orca::xml
