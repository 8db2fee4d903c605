// SPDX-License-Identifier: GPL-3.0-or-later
// Any text gives an object or errors, and an object that was read is the same after writing, bit for bit.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "orca/text/object_xml.hpp"

namespace {

std::optional<orca::ObjectLoan> read(std::string_view text) {
  orca::xml::Diagnostics diagnostics;
  auto object = orca::from_xml(text, "fuzz.xml", diagnostics);
  if (object.has_value() == diagnostics.has_errors()) std::abort();
  return object;
}

std::vector<std::byte> bytes_of(const orca::ObjectLoan& object) {
  std::vector<std::byte> bytes;
  object.type().serialize(object.get(), bytes);
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto object = read(std::string_view(reinterpret_cast<const char*>(data), size));
  if (!object) return 0;
  const std::string text = orca::to_xml(object->type(), object->get());
  const auto again = read(text);
  if (!again || bytes_of(*again) != bytes_of(*object)) std::abort();
  if (orca::to_xml(again->type(), again->get()) != text) std::abort();
  return 0;
}
