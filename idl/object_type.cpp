// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/idl/object_type.hpp"

#include <algorithm>

namespace orca {

const ObjectType* find_object_type(std::string_view name) {
  const auto types = object_types();
  const auto found = std::ranges::lower_bound(types, name, {}, &ObjectType::name);
  return found != types.end() && (*found)->name == name ? *found : nullptr;
}

const ObjectType* find_subtype(const ObjectType& wanted, std::uint64_t layout_hash) {
  if (wanted.layout_hash == layout_hash) return &wanted;
  const auto types = object_types();
  const auto found = std::ranges::find(types, layout_hash, &ObjectType::layout_hash);
  return found != types.end() && is_a(**found, wanted) ? *found : nullptr;
}

TypeId type_id(const ObjectType& type) {
  TypeId id{std::string(type.name), type.layout_hash, std::string(type.layout)};
  for (const ObjectType* at = type.parent; at != nullptr; at = at->parent)
    id.ancestors.push_back({std::string(at->name), at->layout_hash, std::string(at->layout)});
  return id;
}

}  // namespace orca
