// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "orca/base/result.hpp"
#include "orca/graph/property.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// The properties that each component has without a <property>.
inline constexpr std::array<std::string_view, 4> kImplicitProperties{"type", "name", "process", "machine"};

// Returns the properties that a component node declares. What is wrong with one is reported, and it is left out.
Properties read_properties(const Node& component, Report& report);

// Returns whether a text may stand between two of these.
[[nodiscard]] constexpr bool is_quote(char c) { return c == '\'' || c == '"'; }

// Returns the value that is written as a flag, as a number with a unit, or as a text between quotes ('...' or "...").
// Returns nothing if it begins like none of these.
// @errors  invalid_argument if it begins like one of them and is none.
std::optional<Result<PropertyValue>> read_marked_value(std::string_view text);

// Returns the value as it is written in a <property>.
std::string property_text(const PropertyValue& value);
// Returns the value as it is written in a constraint, for messages, too.
std::string constraint_text(const PropertyValue& value);

}  // namespace orca::graph
