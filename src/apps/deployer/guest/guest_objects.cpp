// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "guest_objects.hpp"

#include <cstddef>
#include <span>
#include <vector>

#include "orca/base/text.hpp"

namespace orca::guest {

Packet packet_of(const ObjectRef& object) {
  if (!object) return {"ok"};
  std::vector<std::byte> bytes;
  object.type().serialize(object.get(), bytes);
  return {"ok", std::string(object.type().name),
          std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size())};
}

Result<ObjectLoan> object_of(const Packet& words, const TypeId& wanted) {
  const ObjectType* const type = words.size() == 2 ? find_object_type(words[0]) : nullptr;
  if (type == nullptr || !is_a(type_id(*type), wanted))
    return fail(Code::invalid_argument, "a " + wanted.name + " is expected here, not " +
                                            in_quotes(words.empty() ? std::string() : words[0]));
  ObjectLoan loan = make_object(*type);
  const Status read = type->deserialize(std::as_bytes(std::span(words[1])), loan.get());
  if (!read.ok()) return read.error();
  return loan;
}

}  // namespace orca::guest
