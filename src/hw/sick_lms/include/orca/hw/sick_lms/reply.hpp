// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "orca/hw/sick_lms/configuration.hpp"
#include "orca/hw/sick_lms/variant.hpp"

namespace orca::hw::sick_lms {

/// The first byte of a payload from a laser: that of the request, plus 80 (hex).
enum class ReplyCode : std::uint8_t {
  power_on = 0x90,           ///< Unasked, after power-on or reset: parse_type().
  reset = 0x91,              ///< The laser restarts.
  not_accepted = 0x92,       ///< The request was not understood or is not possible now.
  mode = 0xA0,               ///< parse_mode_answer()
  scan = 0xB0,               ///< parse_scan()
  status = 0xB1,             ///< parse_status()
  errors = 0xB2,             ///< parse_errors()
  range_scan = 0xB7,         ///< parse_scan()
  type = 0xBA,               ///< parse_type()
  variant = 0xBB,            ///< parse_variant()
  configuration = 0xF4,      ///< parse_configuration()
  reflectivity_scan = 0xF5,  ///< parse_scan()
  written = 0xF7,            ///< parse_written()
};

/// The last byte of each payload from a laser.
struct StatusByte {
  std::uint8_t byte = 0;
  /// Returns 0 ok, 1 information, 2 warning, 3 error, 4 fatal error.
  [[nodiscard]] int severity() const { return byte & 0x07; }
  [[nodiscard]] bool is_good() const { return severity() == 0; }
  [[nodiscard]] bool was_restarted() const { return (byte & 0x20) != 0; }
  [[nodiscard]] bool has_implausible_values() const { return (byte & 0x40) != 0; }
  /// Returns whether the front window is dirty: clean it.
  [[nodiscard]] bool is_polluted() const { return (byte & 0x80) != 0; }
};

/// A payload from a laser, taken apart.
struct Reply {
  ReplyCode code = ReplyCode::not_accepted;  ///< May be one that is not listed.
  std::span<const std::uint8_t> data{};      ///< Between code and status.
  StatusByte status{};
};

/// @return  nothing for a payload of fewer than two bytes.
[[nodiscard]] std::optional<Reply> parse_reply(std::span<const std::uint8_t> payload);

/// The answer to a request for a mode.
enum class ModeAnswer : std::uint8_t {
  success = 0,
  refused = 1,  ///< E.g. a wrong password.
  fault = 2,    ///< The laser could not.
  unknown = 3,  ///< A code that is not documented.
};

/// An entry of the laser's list of errors.
struct LaserError {
  std::uint8_t type = 0;
  std::uint8_t number = 0;
  friend bool operator==(const LaserError&, const LaserError&) = default;
};

/// The answer to request_variant().
struct VariantAnswer {
  bool is_accepted = false;
  Variant variant{};  ///< That the laser has now.
  friend bool operator==(const VariantAnswer&, const VariantAnswer&) = default;
};

/// The answer to request_status(). A telegram that ends before a field leaves it 0 or empty.
struct StatusReport {
  std::string firmware;
  std::uint8_t operating_mode = 0;
  bool is_defective = false;
  std::uint8_t variant_type = 0;
  std::uint16_t motor_turns = 0;
  std::uint8_t measuring_mode = 0;
  Variant variant{};
  std::uint8_t restart_mode = 0;
  std::uint16_t restart_time = 0;
  std::uint8_t address = 0;
  Unit unit = Unit::centimetre;
  bool is_laser_on = false;
  std::string boot_firmware;
};

/// The answer to write_configuration().
struct WriteAnswer {
  bool is_accepted = false;
  Configuration configuration;  ///< That the laser has now.
};

/// Each of these returns nothing if the reply has another code or is too short.
[[nodiscard]] std::optional<ModeAnswer> parse_mode_answer(const Reply& reply);
[[nodiscard]] std::optional<VariantAnswer> parse_variant(const Reply& reply);
[[nodiscard]] std::optional<StatusReport> parse_status(const Reply& reply);
[[nodiscard]] std::optional<std::vector<LaserError>> parse_errors(const Reply& reply);
[[nodiscard]] std::optional<Configuration> parse_configuration(const Reply& reply);
[[nodiscard]] std::optional<WriteAnswer> parse_written(const Reply& reply);

/// Returns type and version, e.g. "LMS200;30106;V02.30", without the blanks at its end.
/// @return  nothing if the reply is neither the answer to request_type() nor a report of power-on.
[[nodiscard]] std::optional<std::string> parse_type(const Reply& reply);

}  // namespace orca::hw::sick_lms
