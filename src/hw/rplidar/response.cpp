// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/rplidar/response.hpp"

#include <algorithm>

#include "orca/hw/framing/byte_reader.hpp"
#include "orca/hw/rplidar/capsule.hpp"
#include "orca/hw/rplidar/node.hpp"

namespace orca::hw::rplidar {

namespace {

constexpr std::array kTypes = {DataType::info, DataType::health, DataType::sample_rates, DataType::nodes,
                               DataType::capsules};

constexpr bool is_endless(DataType type) { return type == DataType::nodes || type == DataType::capsules; }

}  // namespace

std::size_t part_size(DataType type) {
  switch (type) {
    case DataType::info: return 20;
    case DataType::health: return 3;
    case DataType::sample_rates: return 4;
    case DataType::nodes: return kNodeSize;
    case DataType::capsules: return kCapsuleSize;
  }
  return 0;
}

// All sizes fit into the first byte.
std::array<std::uint8_t, kDescriptorSize> make_descriptor(DataType type) {
  const auto size = static_cast<std::uint8_t>(part_size(type));
  const std::uint8_t mode = is_endless(type) ? 0x40 : 0x00;
  return {0xA5, 0x5A, size, 0x00, 0x00, mode, static_cast<std::uint8_t>(type)};
}

std::optional<DataType> parse_descriptor(std::span<const std::uint8_t> bytes) {
  const auto type = std::ranges::find_if(
      kTypes, [&](DataType known) { return std::ranges::equal(bytes, make_descriptor(known)); });
  return type == kTypes.end() ? std::nullopt : std::optional(*type);
}

std::string DeviceInfo::serial_text() const {
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::string text;
  for (const std::uint8_t byte : serial) {
    text += kDigits[byte / 16];
    text += kDigits[byte % 16];
  }
  return text;
}

DeviceInfo parse_info(std::span<const std::uint8_t> part) {
  framing::ByteReader reader(part);
  DeviceInfo info;
  info.model = reader.u8();
  info.firmware_minor = reader.u8();
  info.firmware_major = reader.u8();
  info.hardware = reader.u8();
  std::ranges::copy(reader.bytes(info.serial.size()), info.serial.begin());
  return info;
}

Health parse_health(std::span<const std::uint8_t> part) {
  framing::ByteReader reader(part);
  const auto state = static_cast<Health::State>(reader.u8());
  return {state, reader.u16()};
}

SampleRates parse_sample_rates(std::span<const std::uint8_t> part) {
  framing::ByteReader reader(part);
  const double scan = reader.u16() * 1e-6;
  return {scan, reader.u16() * 1e-6};
}

}  // namespace orca::hw::rplidar
