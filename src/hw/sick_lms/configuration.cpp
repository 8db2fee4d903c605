// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/sick_lms/configuration.hpp"

#include <string>

namespace orca::hw::sick_lms {
namespace {

constexpr std::size_t kBlanking = 0;
constexpr std::size_t kStopThreshold = 2;
constexpr std::size_t kPeakThreshold = 3;
constexpr std::size_t kAvailability = 4;
constexpr std::size_t kMeasuringMode = 5;
constexpr std::size_t kUnit = 6;

}  // namespace

Result<Configuration> Configuration::of(std::span<const std::uint8_t> block) {
  if (block.size() > kMostBytes)
    return fail(Code::data_loss, "a configuration of " + std::to_string(block.size()) +
                                     " bytes; a telegram holds at most " + std::to_string(kMostBytes));
  Configuration configuration;
  for (const std::uint8_t byte : block) configuration.block_.push_back(byte);
  return configuration;
}

std::optional<std::uint8_t> Configuration::byte_at(std::size_t offset) const {
  return offset < block_.size() ? std::optional(block_[offset]) : std::nullopt;
}

std::optional<std::uint16_t> Configuration::blanking() const {
  const auto high = byte_at(kBlanking + 1);
  if (!high) return std::nullopt;
  return static_cast<std::uint16_t>(block_[kBlanking] + 256U * *high);
}

std::optional<std::uint8_t> Configuration::stop_threshold() const { return byte_at(kStopThreshold); }
std::optional<std::uint8_t> Configuration::peak_threshold() const { return byte_at(kPeakThreshold); }
std::optional<std::uint8_t> Configuration::availability() const { return byte_at(kAvailability); }
std::optional<std::uint8_t> Configuration::measuring_mode() const { return byte_at(kMeasuringMode); }

std::optional<Unit> Configuration::unit() const {
  const auto byte = byte_at(kUnit);
  if (!byte) return std::nullopt;
  return static_cast<Unit>(*byte);
}

Status Configuration::set(std::size_t offset, std::uint8_t byte) {
  if (offset >= block_.size())
    return fail(Code::failed_precondition, "the laser's configuration has " + std::to_string(block_.size()) +
                                               " bytes and no byte " + std::to_string(offset) +
                                               "; this laser does not have the setting");
  block_[offset] = byte;
  return ok();
}

Status Configuration::set_availability(std::uint8_t bits) { return set(kAvailability, bits); }
Status Configuration::set_measuring_mode(std::uint8_t mode) { return set(kMeasuringMode, mode); }
Status Configuration::set_unit(Unit unit) { return set(kUnit, static_cast<std::uint8_t>(unit)); }
Status Configuration::set_peak_threshold(std::uint8_t threshold) { return set(kPeakThreshold, threshold); }

}  // namespace orca::hw::sick_lms
