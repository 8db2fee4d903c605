// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "orca/base/result.hpp"
#include "orca/hw/sick_lms/telegram.hpp"
#include "orca/hw/sick_lms/variant.hpp"

namespace orca::hw::sick_lms {

/// A family of lasers with what differs on the line.
struct Family {
  std::string_view password{};   ///< Of the installation mode.
  bool has_even_parity = false;  ///< 8 data bits with even parity; otherwise none.
};

inline constexpr Family kLms{.password = "SICK_LMS", .has_even_parity = false};
inline constexpr Family kPls{.password = "SICK_PLS", .has_even_parity = true};

/// A part of the beams, both ends included, counted from 1 at the right.
struct PointRange {
  std::uint16_t first = 1;
  std::uint16_t last = 1;
};

/// The operating modes that need no parameters.
enum class Mode : std::uint8_t {
  diagnosis = 0x10,
  all_scans = 0x24,      ///< Sends every scan (B0) until another mode is chosen.
  on_request = 0x25,     ///< Sends values when asked. The way to stop whatever is being sent.
  partial_scans = 0x2A,  ///< Sends every turn of the mirror for itself, as it is measured.
};

/// The operating modes that send a part of the beams.
enum class RangeMode : std::uint8_t {
  scans = 0x27,              ///< Scans (B7).
  flagged_scans = 0x29,      ///< Scans with the bits of the fields.
  with_reflectivity = 0x50,  ///< Distances and reflectivity.
};

/// Restarts the laser; it answers 91, and 90 when it is ready again.
[[nodiscard]] Telegram request_reset();
/// Asks for one scan, in Mode::on_request.
[[nodiscard]] Telegram request_scan();
/// Asks for the status: parse_status().
[[nodiscard]] Telegram request_status();
/// Asks for the list of errors: parse_errors().
[[nodiscard]] Telegram request_errors();
/// Asks for type and version: parse_type().
[[nodiscard]] Telegram request_type();
/// Asks for the configuration: parse_configuration().
[[nodiscard]] Telegram request_configuration();

/// Chooses the beams until the laser is switched off; not while it sends scans. Answered by parse_variant().
[[nodiscard]] Telegram request_variant(const Variant& variant);

/// Chooses a mode. Answered within 3 s by parse_mode_answer(), as are all requests for modes.
[[nodiscard]] Telegram request_mode(Mode mode);
/// Chooses the installation mode, which is needed to write the configuration.
[[nodiscard]] Telegram request_installation(const Family& family = kLms);
/// Chooses a mode that sends a part of the beams.
[[nodiscard]] Telegram request_range(RangeMode mode, PointRange points);
/// Chooses to send means of `count` scans.
[[nodiscard]] Telegram request_means(std::uint8_t count);
/// Chooses to send means of `count` scans, for a part of the beams.
[[nodiscard]] Telegram request_means(std::uint8_t count, PointRange points);
/// Chooses to send distances and reflectivity of some parts of the beams (F5).
/// @errors  invalid_argument for more parts than fit into a telegram.
[[nodiscard]] Result<Telegram> request_reflectivity(std::span<const PointRange> parts);

/// Changes the rate of the line. The answer comes at the old rate; then both sides change, and the laser wants to be left
/// alone for 250 to 500 ms.
/// @param baud  9600, 19200, 38400 or 500000.
/// @errors  invalid_argument for another rate, with those that are possible.
[[nodiscard]] Result<Telegram> request_rate(unsigned baud);

/// Writes the configuration, in installation mode. It takes up to 15 s and wears the laser's memory: read first, and write only what differs.
/// @param block  As parse_configuration() gave it, of any length.
/// @errors  invalid_argument for an empty block or one that no telegram can hold.
[[nodiscard]] Result<Telegram> write_configuration(std::span<const std::uint8_t> block);

}  // namespace orca::hw::sick_lms
