// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/framing/checksums.hpp"

#include <cstddef>

namespace orca::hw::framing {

std::uint16_t sum_of_words(std::span<const std::uint8_t> bytes) {
  std::uint32_t sum = 0;
  const std::size_t even = bytes.size() / 2 * 2;
  for (std::size_t i = 0; i < even; i += 2) sum += std::uint32_t{bytes[i]} * 256 + bytes[i + 1];
  if (even < bytes.size()) sum ^= bytes[even];
  return static_cast<std::uint16_t>(sum & 0xFFFF);
}

std::uint16_t crc_of_pairs(std::span<const std::uint8_t> bytes) {
  constexpr std::uint32_t kGenerator = 0x8005;
  std::uint32_t crc = 0;
  std::uint32_t previous = 0;
  for (const std::uint8_t byte : bytes) {
    const bool carry = (crc & 0x8000) != 0;
    crc = (crc << 1) & 0xFFFF;
    if (carry) crc ^= kGenerator;
    crc ^= byte + 256 * previous;
    previous = byte;
  }
  return static_cast<std::uint16_t>(crc);
}

std::uint8_t sum_of_bytes(std::span<const std::uint8_t> bytes) {
  std::uint32_t sum = 0;
  for (const std::uint8_t byte : bytes) sum += byte;
  return static_cast<std::uint8_t>(sum & 0xFF);
}

std::uint16_t crc_ccitt(std::span<const std::uint8_t> bytes) {
  constexpr std::uint32_t kGenerator = 0x1021;
  std::uint32_t crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc ^= std::uint32_t{byte} << 8;
    for (int bit = 0; bit < 8; ++bit) crc = (crc << 1) ^ ((crc & 0x8000) != 0 ? kGenerator : 0);
  }
  return static_cast<std::uint16_t>(crc & 0xFFFF);
}

}  // namespace orca::hw::framing
