// SPDX-License-Identifier: LGPL-3.0-or-later
#include "bytes.hpp"

#include <zlib.h>

namespace orca::recording {

void put(Bytes& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()), std::as_bytes(std::span(text)));
}

void put(Bytes& out, const Values& values) {
  Bytes inner;
  for (const auto& [name, value] : values) put(inner, name, value);
  put(out, static_cast<std::uint32_t>(inner.size()), inner);
}

void put(Bytes& out, const CountsByChannel& counts) {
  put(out, static_cast<std::uint32_t>(counts.size() * 10));
  for (const auto& [channel, count] : counts) put(out, channel, count);
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

void Cursor::get(std::string& text) {
  const auto bytes = take(number<std::uint32_t>());
  text.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

void Cursor::get(Values& values) {
  Cursor inner(take(number<std::uint32_t>()));
  while (inner.is_good() && !inner.left().empty()) {
    std::string name;
    inner.get(name);
    inner.get(values[std::move(name)]);
  }
  good_ = good_ && inner.is_good();
}

void Cursor::get(CountsByChannel& counts) {
  Cursor inner(take(number<std::uint32_t>()));
  while (inner.is_good() && !inner.left().empty()) inner.get(counts[inner.number<std::uint16_t>()]);
  good_ = good_ && inner.is_good();
}

std::uint32_t crc_of(std::span<const std::byte> bytes) {
  uLong crc = crc32_z(0, nullptr, 0);
  return static_cast<std::uint32_t>(crc32_z(crc, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace orca::recording
