// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace orca::supervisor {

/// A value with its name, for people and programs. A plain value.
struct Cell {
  /// What the value is, for JSON.
  enum class Kind : std::uint8_t { text, number, flag };

  std::string name;   ///< A word of lower-case letters and '_', as in JSON.
  std::string value;  ///< A text; a decimal number, or empty: none; "true" or "false".
  Kind kind = Kind::text;

  Cell() = default;
  Cell(std::string called, std::string text) : name(std::move(called)), value(std::move(text)) {}
  Cell(std::string called, const char* text) : name(std::move(called)), value(text) {}
  Cell(std::string called, bool is_so)
      : name(std::move(called)), value(is_so ? "true" : "false"), kind(Kind::flag) {}
  template <std::integral Number>
  requires(!std::same_as<Number, bool>) Cell(std::string called, Number number)
      : name(std::move(called)), value(std::to_string(number)), kind(Kind::number) {}
  /// A number with `digits` digits after the point.
  Cell(std::string called, double number, int digits);
};

/// A line of a table. Lines with cells of the same names belong to one table.
using Record = std::vector<Cell>;

}  // namespace orca::supervisor
