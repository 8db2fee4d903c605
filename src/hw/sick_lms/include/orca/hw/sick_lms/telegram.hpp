// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "orca/hw/framing/scanner.hpp"
#include "orca/hw/framing/short_list.hpp"

/// The telegrams of SICK LMS2xx laser scanners, and of the PLS as far as it is the same: bytes to values and back, without
/// clock and I/O. All its functions are pure; any thread.
/// @source  SICK, LMS2xx telegram listing.
namespace orca::hw::sick_lms {

inline constexpr std::size_t kLongestPayload = 812;                   ///< [bytes] code, data and status.
inline constexpr std::size_t kLongestTelegram = kLongestPayload + 6;  ///< [bytes] with header and check word.

/// A whole telegram, ready to be sent. At 500000 baud a laser wants at least 55 us between two bytes from the host.
using Telegram = framing::FrameBytes<kLongestTelegram>;

/// What a frame from a laser is.
enum class Heard {
  telegram,  ///< A reply or a scan: see payload_of().
  ack,  ///< The lone byte 06: a request has arrived whole. Its reply follows. Some lasers do not send it.
  nak,  ///< The lone byte 15 (hex): a request has arrived damaged; send it again.
};

/// Recognises a telegram from a laser, or a lone 06 or 15. Where Frame::skipped is not 0, such a lone byte may also be part of
/// a telegram whose beginning was not heard; do not rely on it.
[[nodiscard]] framing::Finding look_from_laser(std::span<const std::uint8_t> bytes);

/// Recognises a telegram to a laser: our own, which a loop sends back.
[[nodiscard]] framing::Finding look_from_host(std::span<const std::uint8_t> bytes);

inline constexpr framing::Protocol kFromLaser{.look = look_from_laser, .longest = kLongestTelegram};
inline constexpr framing::Protocol kFromHost{.look = look_from_host, .longest = kLongestTelegram};

/// @pre  `frame` was found with kFromLaser.
[[nodiscard]] Heard heard(std::span<const std::uint8_t> frame);

/// Returns what lies between header and check word: code, data and, from a laser, the status byte.
/// @pre  `telegram` was found with kFromLaser or kFromHost and is no lone byte.
[[nodiscard]] std::span<const std::uint8_t> payload_of(std::span<const std::uint8_t> telegram);

/// Returns the telegram to a laser around a command and its data.
/// @pre  The payload has 1 to kLongestPayload bytes.
[[nodiscard]] Telegram make_request(std::span<const std::uint8_t> payload);

}  // namespace orca::hw::sick_lms
