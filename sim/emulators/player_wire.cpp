// SPDX-License-Identifier: LGPL-3.0-or-later
#include "player_wire.hpp"

#include <bit>

namespace orca::emulators {

PlayerWriter& PlayerWriter::word(std::uint32_t value) {
  for (const unsigned shift : {24U, 16U, 8U, 0U})
    bytes_.push_back(static_cast<std::uint8_t>((value >> shift) & 0xFFU));
  return *this;
}

PlayerWriter& PlayerWriter::single(double value) {
  return word(std::bit_cast<std::uint32_t>(static_cast<float>(value)));
}

PlayerWriter& PlayerWriter::real(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return word(static_cast<std::uint32_t>(bits >> 32)).word(static_cast<std::uint32_t>(bits));
}

PlayerWriter& PlayerWriter::count(std::size_t count) {
  return word(static_cast<std::uint32_t>(count)).word(static_cast<std::uint32_t>(count));
}

PlayerWriter& PlayerWriter::octets(std::span<const std::uint8_t> list) {
  count(list.size());
  bytes_.insert(bytes_.end(), list.begin(), list.end());
  bytes_.resize(bytes_.size() + (4 - list.size() % 4) % 4);
  return *this;
}

PlayerWriter& PlayerWriter::text(std::string_view text) {
  std::vector<std::uint8_t> list(text.begin(), text.end());
  list.push_back(0);
  return octets(list);
}

std::uint32_t player_word(std::span<const std::uint8_t> bytes, std::size_t offset) {
  std::uint32_t value = 0;
  if (offset + 4 > bytes.size()) return value;
  for (const std::uint8_t byte : bytes.subspan(offset, 4)) value = value << 8 | byte;
  return value;
}

double player_real(std::span<const std::uint8_t> bytes, std::size_t offset) {
  const std::uint64_t high = player_word(bytes, offset);
  return std::bit_cast<double>(high << 32 | player_word(bytes, offset + 4));
}

PlayerHeader read_player_header(std::span<const std::uint8_t> bytes) {
  return {.interface = player_word(bytes, 8),
          .index = player_word(bytes, 12),
          .type = player_word(bytes, 16),
          .subtype = player_word(bytes, 20),
          .sequence = player_word(bytes, 32),
          .size = player_word(bytes, 36)};
}

}  // namespace orca::emulators
