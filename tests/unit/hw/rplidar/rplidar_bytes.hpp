// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "orca/hw/rplidar/capsule.hpp"
#include "orca/hw/rplidar/node.hpp"

/// What a scanner sends, written from the vendor's protocol.
namespace orca::hw::rplidar {

inline std::array<std::uint8_t, kNodeSize> encode_node(const Node& node) {
  const unsigned angle = 2U * node.angle + 1U;
  const auto byte = [](unsigned value) { return static_cast<std::uint8_t>(value & 0xFF); };
  return {byte(4U * node.quality + (node.begins_scan ? 1U : 2U)), byte(angle), byte(angle >> 8),
          byte(node.distance), byte(node.distance >> 8U)};
}

inline std::array<std::uint8_t, kCapsuleSize> encode_capsule(const Capsule& capsule) {
  std::array<std::uint8_t, kCapsuleSize> bytes{};
  const auto put = [&](std::size_t at, unsigned word) {
    bytes[at] = static_cast<std::uint8_t>(word & 0xFF);
    bytes[at + 1] = static_cast<std::uint8_t>(word >> 8 & 0xFF);
  };
  const auto word = [](const Capsule::Sample& sample) {
    return 4U * (sample.distance & 0x3FFFU) + (sample.correction >> 4 & 3U);
  };
  put(2, (capsule.start & 0x7FFFU) | (capsule.is_first ? 0x8000U : 0U));
  for (std::size_t i = 0; i < kCapsulePoints / 2; ++i) {
    const Capsule::Sample& first = capsule.samples[2 * i];
    const Capsule::Sample& second = capsule.samples[2 * i + 1];
    const std::size_t at = 4 + 5 * i;
    put(at, word(first));
    put(at + 2, word(second));
    bytes[at + 4] = static_cast<std::uint8_t>((first.correction & 0xFU) | (second.correction & 0xFU) << 4);
  }
  unsigned sum = 0;
  for (const std::uint8_t byte : std::span(bytes).subspan(2)) sum ^= byte;
  bytes[0] = static_cast<std::uint8_t>(0xA0U | (sum & 0xFU));
  bytes[1] = static_cast<std::uint8_t>(0x50U | sum >> 4U);
  return bytes;
}

}  // namespace orca::hw::rplidar
