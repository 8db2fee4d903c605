// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "orca/base/result.hpp"
#include "orca/hw/sick_lms/telegram.hpp"
#include "orca/hw/sick_lms/variant.hpp"

namespace orca::hw::sick_lms {

inline constexpr std::string_view kLmsPassword = "SICK_LMS";  ///< Of the installation mode.
inline constexpr std::string_view kPlsPassword = "SICK_PLS";

/// The operating modes that a driver needs.
enum class Mode : std::uint8_t {
  all_scans = 0x24,   ///< Sends every scan (B0) until another mode is chosen.
  on_request = 0x25,  ///< Sends values when asked. The way to stop whatever is being sent.
};

/// Asks for the status; that it answers shows that it is there.
[[nodiscard]] Telegram request_status();
/// Asks for type and version: parse_type().
[[nodiscard]] Telegram request_type();
/// Asks for the configuration: parse_configuration().
[[nodiscard]] Telegram request_configuration();

/// Chooses the beams until the laser is switched off; not while it sends scans. Answered by parse_variant().
[[nodiscard]] Telegram request_variant(const Variant& variant);

/// Chooses a mode. Answered within 3 s by parse_mode_answer(), as are all requests for modes.
[[nodiscard]] Telegram request_mode(Mode mode);
/// Chooses the installation mode, which is needed to write the configuration.
[[nodiscard]] Telegram request_installation(std::string_view password);
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
