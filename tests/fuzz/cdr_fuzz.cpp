// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes give an object or an error, for every object type. An object that was read is the same after
// writing. The first byte of the input chooses the type; the rest is the payload.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "orca/idl/object.hpp"

namespace {

std::vector<std::byte> payload_of(const orca::ObjectLoan& object) {
  std::vector<std::byte> payload;
  object.type().serialize(object.get(), payload);
  return payload;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto types = orca::object_types();
  const orca::ObjectType& type = *types[data[0] % types.size()];
  orca::ObjectLoan object = orca::make_object(type);
  const orca::Status read = type.deserialize(std::as_bytes(std::span(data + 1, size - 1)), object.get());
  if (!read.ok()) {
    if (read.error().code != orca::Code::data_loss || read.error().message.empty()) std::abort();
    (void)payload_of(object);  // it is valid, whatever its fields are
    return 0;
  }
  const std::vector<std::byte> written = payload_of(object);
  orca::ObjectLoan again = orca::make_object(type);
  if (!type.deserialize(written, again.get()).ok()) std::abort();
  if (payload_of(again) != written) std::abort();
  (void)std::move(object).seal().dump();
  return 0;
}
