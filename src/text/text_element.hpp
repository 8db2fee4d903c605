// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/idl/value.hpp"

namespace orca::text {

// What an element of a list is to XML: a struct is itself, and a text, which has no fields, is shown as a
// struct whose one field is called "value".
// `element`: a struct or a text.
[[nodiscard]] inline StructValue as_struct(const Value& element) {
  if (const auto* part = std::get_if<StructValue>(&element.of)) return *part;
  const auto show = [](void* text, FieldVisitor& visitor) {
    visitor.field({.name = "value", .unit = ""}, {static_cast<std::string*>(text)});
  };
  return {.type = "string", .object = std::get<std::string*>(element.of), .fields = show};
}

}  // namespace orca::text
