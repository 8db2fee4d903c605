// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/idl/value.hpp"

namespace orca::text {

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
