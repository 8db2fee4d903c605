// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "orca/base/result.hpp"
#include "orca/hw/framing/short_list.hpp"
#include "orca/hw/sick_lms/telegram.hpp"
#include "orca/hw/sick_lms/variant.hpp"

namespace orca::hw::sick_lms {

/// The unit of distances, as scans and the configuration name it.
enum class Unit : std::uint8_t { centimetre = 0, millimetre = 1, decimetre = 2 };

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
  [[nodiscard]] std::optional<std::uint8_t> measuring_mode() const;
  [[nodiscard]] std::optional<Unit> unit() const;

  /// Sets a field.
  /// @errors  failed_precondition if the block ends before the field.
  [[nodiscard]] Status set_measuring_mode(std::uint8_t mode);
  [[nodiscard]] Status set_unit(Unit unit);

  friend bool operator==(const Configuration&, const Configuration&) = default;

 private:
  [[nodiscard]] std::optional<std::uint8_t> byte_at(std::size_t offset) const;
  [[nodiscard]] Status set(std::size_t offset, std::uint8_t byte);

  framing::ShortList<std::uint8_t, kMostBytes> block_;
};

/// The first byte of a payload from a laser: that of the request, plus 80 (hex).
enum class ReplyCode : std::uint8_t {
  power_on = 0x90,      ///< Unasked, after power-on or reset.
  not_accepted = 0x92,  ///< The request was not understood or is not possible now.
  mode = 0xA0,          ///< parse_mode_answer()
  scan = 0xB0,          ///< parse_scan()
  status = 0xB1,
  type = 0xBA,           ///< parse_type()
  variant = 0xBB,        ///< parse_variant()
  configuration = 0xF4,  ///< parse_configuration()
  written = 0xF7,        ///< parse_written()
};

/// The last byte of each payload from a laser.
struct StatusByte {
  std::uint8_t byte = 0;
  /// Returns 0 ok, 1 information, 2 warning, 3 error, 4 fatal error.
  [[nodiscard]] int severity() const { return byte & 0x07; }
  [[nodiscard]] bool is_good() const { return severity() == 0; }
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

/// The answer to request_variant().
struct VariantAnswer {
  bool is_accepted = false;
  Variant variant{};  ///< That the laser has now.
  friend bool operator==(const VariantAnswer&, const VariantAnswer&) = default;
};

/// The answer to write_configuration().
struct WriteAnswer {
  bool is_accepted = false;
  Configuration configuration;  ///< That the laser has now.
};

/// Each of these returns nothing if the reply has another code or is too short.
[[nodiscard]] std::optional<ModeAnswer> parse_mode_answer(const Reply& reply);
[[nodiscard]] std::optional<VariantAnswer> parse_variant(const Reply& reply);
[[nodiscard]] std::optional<Configuration> parse_configuration(const Reply& reply);
[[nodiscard]] std::optional<WriteAnswer> parse_written(const Reply& reply);

/// Returns type and version, e.g. "LMS200;30106;V02.30", without the blanks at its end.
/// @return  nothing if the reply is not the answer to request_type().
[[nodiscard]] std::optional<std::string> parse_type(const Reply& reply);

}  // namespace orca::hw::sick_lms
