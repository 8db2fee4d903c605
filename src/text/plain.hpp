// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "codes.hpp"
#include "orca/idl/value.hpp"

namespace orca::text {

// Returns whether a value is one attribute in XML (true), or one or more elements (false).
[[nodiscard]] bool is_attribute(const Value& value);

// Returns whether a value is the default: 0 (not -0), false, empty, the first enumerator, or an array or
// struct of these.
[[nodiscard]] bool is_default(const Value& value);

// Returns the text of a value that is an attribute. XML can hold it once its special characters are escaped.
[[nodiscard]] std::string plain_text(const Value& value);

// Reads a value from its text. `unit` is the unit of the field. A wrong value leaves the object's value as it
// was; a wrong list leaves it in any state.
[[nodiscard]] Verdict read_plain(std::string_view text, std::string_view unit, const Value& value);

// Returns an element of a list, a struct or a text, as the struct that XML shows. A text has no fields, so it
// becomes a struct with the one field "value".
[[nodiscard]] inline StructValue as_struct(const Value& element) {
  if (const auto* part = std::get_if<StructValue>(&element.of)) return *part;
  const auto show = [](void* text, FieldVisitor& visitor) {
    visitor.field({.name = "value", .unit = ""}, {static_cast<std::string*>(text)});
  };
  return {.type = "string", .object = std::get<std::string*>(element.of), .fields = show};
}

}  // namespace orca::text
