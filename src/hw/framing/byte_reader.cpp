// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/framing/byte_reader.hpp"

#include <algorithm>

namespace orca::hw::framing {

std::uint8_t ByteReader::u8() {
  if (bytes_.empty()) return 0;
  const std::uint8_t byte = bytes_.front();
  bytes_ = bytes_.subspan(1);
  return byte;
}

std::uint16_t ByteReader::u16() {
  const unsigned low = u8();
  return static_cast<std::uint16_t>(low + 256U * u8());
}

std::uint32_t ByteReader::u32() {
  const std::uint32_t low = u16();
  return low + (std::uint32_t{u16()} << 16);
}

std::span<const std::uint8_t> ByteReader::bytes(std::size_t count) {
  const auto taken = bytes_.first(std::min(count, bytes_.size()));
  bytes_ = bytes_.subspan(taken.size());
  return taken;
}

std::string_view ByteReader::text(std::size_t count) {
  const auto taken = bytes(count);
  return {reinterpret_cast<const char*>(taken.data()), taken.size()};
}

std::string_view ByteReader::text_to_zero() {
  const auto zero = std::ranges::find(bytes_, std::uint8_t{0});
  const std::string_view found = text(static_cast<std::size_t>(zero - bytes_.begin()));
  u8();
  return found;
}

}  // namespace orca::hw::framing
