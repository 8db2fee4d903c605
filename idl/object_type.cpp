// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/idl/object_type.hpp"

#include <algorithm>

namespace orca {

const ObjectType* find_object_type(std::string_view name) {
  const auto types = object_types();
  const auto found = std::ranges::lower_bound(types, name, {}, &ObjectType::name);
  return found != types.end() && (*found)->name == name ? *found : nullptr;
}

TypeId type_id(const ObjectType& type) {
  return {std::string(type.name), type.layout_hash, std::string(type.layout)};
}

}  // namespace orca
