// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace orca::hw::rplidar {

inline constexpr std::size_t kDescriptorSize = 7;  ///< [bytes]

/// What an answer consists of.
enum class DataType : std::uint8_t {
  info = 0x04,          ///< One DeviceInfo.
  health = 0x06,        ///< One Health.
  sample_rates = 0x15,  ///< One SampleRates.
  nodes = 0x81,         ///< Nodes without end.
  capsules = 0x82,      ///< Capsules without end.
};

/// Returns the bytes that announce an answer: A5 5A, the size of its parts in 30 bits, 1 in 2 bits if they have no end,
/// and their type.
[[nodiscard]] std::array<std::uint8_t, kDescriptorSize> make_descriptor(DataType type);

/// Reads a descriptor. Size and mode must be those of the type.
/// @return  nothing if these bytes are none, or announce what is not in DataType.
[[nodiscard]] std::optional<DataType> parse_descriptor(std::span<const std::uint8_t> bytes);

/// Returns the size of a part of an answer [bytes].
[[nodiscard]] std::size_t part_size(DataType type);

/// A plain value.
struct DeviceInfo {
  std::uint8_t model = 0;  ///< High and low four bits: 0x18 is an A1M8.
  std::uint8_t firmware_major = 0;
  std::uint8_t firmware_minor = 0;
  std::uint8_t hardware = 0;
  std::array<std::uint8_t, 16> serial{};
  friend bool operator==(const DeviceInfo&, const DeviceInfo&) = default;

  /// Returns the serial number in 32 hexadecimal digits, as the vendor's programs show it.
  [[nodiscard]] std::string serial_text() const;
};

/// A plain value.
struct Health {
  enum class State : std::uint8_t {
    good = 0,
    warning = 1,  ///< It works, but may fail soon.
    error = 2,    ///< It has stopped to protect itself; a reset may help.
  };
  State state = State::good;  ///< Values that have no name occur.
  std::uint16_t error = 0;    ///< Number for the vendor.
  friend bool operator==(const Health&, const Health&) = default;
};

/// Time between points. A plain value.
struct SampleRates {
  double scan = 0.0;          ///< [s] after Request::scan.
  double express_scan = 0.0;  ///< [s] after Request::express_scan.
  friend bool operator==(const SampleRates&, const SampleRates&) = default;
};

/// Each of these reads the part of an answer.
/// @pre  `part` has part_size() bytes.
[[nodiscard]] DeviceInfo parse_info(std::span<const std::uint8_t> part);
[[nodiscard]] Health parse_health(std::span<const std::uint8_t> part);
[[nodiscard]] SampleRates parse_sample_rates(std::span<const std::uint8_t> part);

}  // namespace orca::hw::rplidar
