// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/idl/object_type.hpp"

#include "orca/idl/make_object_type.hpp"

namespace orca {

namespace detail {

void append_written(std::size_t (*write)(const void* object, std::span<std::byte> to), const void* object,
                    std::vector<std::byte>& out) {
  constexpr std::size_t kGuess = 512;  // [bytes] most objects take less
  const std::size_t start = out.size();
  out.resize(start + kGuess);
  const std::size_t size = write(object, std::span(out).subspan(start));
  out.resize(start + size);
  if (size > kGuess) write(object, std::span(out).subspan(start));
}

}  // namespace detail

TypeId type_id(const ObjectType& type) {
  TypeId id{std::string(type.name), type.layout_hash, std::string(type.layout)};
  for (const ObjectType* at = type.parent; at != nullptr; at = at->parent)
    id.ancestors.push_back({std::string(at->name), at->layout_hash, std::string(at->layout)});
  return id;
}

}  // namespace orca
