// SPDX-License-Identifier: LGPL-3.0-or-later
#include "bytes.hpp"

#include <zlib.h>

#include <algorithm>

namespace orca::recording {

void put(Bytes& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  put(out, std::as_bytes(std::span(text)));
}

void put(Bytes& out, const Values& values) {
  Bytes inner;
  for (const auto& [name, value] : values) {
    put(inner, std::string_view(name));
    put(inner, std::string_view(value));
  }
  put(out, static_cast<std::uint32_t>(inner.size()));
  put(out, inner);
}

std::span<const std::byte> Cursor::take(std::uint64_t count) {
  if (!good_ || count > left_.size()) {
    good_ = false;
    return {};
  }
  const auto taken = left_.first(count);
  left_ = left_.subspan(count);
  return taken;
}

std::string Cursor::text() {
  const auto bytes = take(number<std::uint32_t>());
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

Values Cursor::values() {
  Cursor inner(take(number<std::uint32_t>()));
  Values values;
  while (inner.is_good() && !inner.left().empty()) {
    std::string name = inner.text();
    values[std::move(name)] = inner.text();
  }
  good_ = good_ && inner.is_good();
  return values;
}

std::uint32_t crc_of(std::span<const std::byte> bytes) {
  uLong crc = crc32_z(0, nullptr, 0);
  return static_cast<std::uint32_t>(crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace orca::recording
