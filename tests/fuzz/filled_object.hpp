// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <variant>

#include "orca/idl/object.hpp"

namespace orca::test {

/// Gives every list one element and every text some characters, down to the last struct.
class Filler final : public FieldVisitor {
 public:
  void field(const FieldInfo& /*info*/, const Value& value) override { fill(value); }

 private:
  void fill(const Value& value) {
    if (const auto* const text = std::get_if<std::string*>(&value.of)) **text = "text";
    if (const auto* const inner = std::get_if<StructValue>(&value.of)) inner->fields(inner->object, *this);
    if (const auto* const list = std::get_if<ListValue>(&value.of)) fill(*list);
  }
  void fill(const ListValue& list) {
    if (list.resize != nullptr) list.resize(list.list, 1);
    for (std::size_t i = 0; i < list.size(list.list); ++i) fill(list.at(list.list, i));
  }
};

/// Returns an object whose lists have one element each.
inline ObjectLoan filled_object(const ObjectType& type) {
  ObjectLoan object = make_object(type);
  Filler filler;
  type.fields(object.get(), filler);
  return object;
}

}  // namespace orca::test
