// SPDX-License-Identifier: LGPL-3.0-or-later
// The language in which a graph says what it seeks (thesis 7.5):
//   CONSTRAINT = TERM { ";" TERM }      TERM = NAME OP VALUE
//   OP = "==" | "=" | "!=" | ">=" | "<=" | ">" | "<"
//   VALUE = number with a unit | true | false | 'text' | "text"
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/graph/property.hpp"

namespace orca::graph {

enum class Comparison { equal, unequal, at_least, at_most, more, less };

const char* to_string(Comparison comparison);

// One condition on one property.
struct Term {
  std::string name;
  Comparison comparison = Comparison::equal;
  PropertyValue value;

  [[nodiscard]] std::string text() const;
};

// All terms must hold. There is at least one.
using Constraint = std::vector<Term>;

// What is wrong with a constraint, and where.
struct ConstraintFault {
  std::size_t column = 0;  // in characters, from 1
  std::string message;     // what was expected
};

// Returns the constraint that a text is; nothing with a fault.
std::optional<Constraint> parse_constraint(std::string_view text, ConstraintFault& fault);

// A wish for the largest or smallest value of a property.
struct Preference {
  std::string name;
  bool largest = true;
};

// Returns the preference in "max NAME" or "min NAME"; nothing with a fault.
std::optional<Preference> parse_preference(std::string_view text, ConstraintFault& fault);

// Returns whether a text is meant as a constraint, not as a list of names.
bool looks_like_constraint(std::string_view text);

enum class TermOutcome { holds, misses, incomparable };

// Returns whether a property meets a term. A number of another unit, a text and a flag cannot be compared with each other.
// A plain number fits any unit.
TermOutcome evaluate(const Term& term, const PropertyValue& property);

// Returns whether two numbers measure the same, as far as they say it.
bool are_comparable(const Quantity& a, const Quantity& b);

}  // namespace orca::graph
