// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "orca/base/result.hpp"
#include "orca/hw/framing/short_list.hpp"
#include "orca/hw/sick_lms/measuring_mode.hpp"
#include "orca/hw/sick_lms/telegram.hpp"

namespace orca::hw::sick_lms {

/// The block of settings that a laser keeps. Its length depends on the firmware; what is not set here stays as it was
/// read.
///
/// A plain value.
class Configuration {
 public:
  static constexpr std::size_t kMostBytes = kLongestPayload - 2;  ///< Beside code and status.

  /// @errors  data_loss if the block is too long for a telegram.
  [[nodiscard]] static Result<Configuration> of(std::span<const std::uint8_t> block);

  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return block_.view(); }

  /// These return nothing if the block ends before the field.
  [[nodiscard]] std::optional<std::uint16_t> blanking() const;
  [[nodiscard]] std::optional<std::uint8_t> stop_threshold() const;
  /// Returns the peak threshold of an LMS200, or the sensitivity of other lasers: 0 standard, 1 medium, 2 low, 3 high.
  [[nodiscard]] std::optional<std::uint8_t> peak_threshold() const;
  /// Returns bits: 0 high availability, 1 real-time index in scans, 2 dazzling has no effect on outputs.
  [[nodiscard]] std::optional<std::uint8_t> availability() const;
  [[nodiscard]] std::optional<std::uint8_t> measuring_mode() const;
  [[nodiscard]] std::optional<Unit> unit() const;

  /// Sets a field.
  /// @errors  failed_precondition if the block ends before the field.
  [[nodiscard]] Status set_availability(std::uint8_t bits);
  [[nodiscard]] Status set_measuring_mode(std::uint8_t mode);
  [[nodiscard]] Status set_unit(Unit unit);
  [[nodiscard]] Status set_peak_threshold(std::uint8_t threshold);

  friend bool operator==(const Configuration&, const Configuration&) = default;

 private:
  [[nodiscard]] std::optional<std::uint8_t> byte_at(std::size_t offset) const;
  [[nodiscard]] Status set(std::size_t offset, std::uint8_t byte);

  framing::ShortList<std::uint8_t, kMostBytes> block_;
};

}  // namespace orca::hw::sick_lms
