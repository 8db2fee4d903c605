// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "orca/hw/framing/scanner.hpp"
#include "orca/hw/framing/short_list.hpp"

namespace orca::hw::create2 {

inline constexpr std::size_t kLongestBody = 255;   ///< [bytes] that the length byte can tell of.
inline constexpr std::size_t kLongestFrame = 258;  ///< [bytes] header, length, body and checksum.

/// A frame of a stream.
using StreamFrame = framing::FrameBytes<kLongestFrame>;

/// Recognises a frame at the first of these bytes: 19, length, packets each after its number, checksum. All bytes
/// together have the sum 0, the header included; in the manual of the first Create it was not. Because the checksum
/// has 8 bits only, the packets must also fit exactly into the length.
[[nodiscard]] framing::Finding look(std::span<const std::uint8_t> bytes);

/// The framing of streams, for a framing::Scanner. Lines of text that the robot prints are passed over.
inline constexpr framing::Protocol kProtocol{.look = look, .longest = kLongestFrame};

/// Returns the packets of a frame, each after its number: Sensors::apply_body().
/// @pre  `frame` is one that a scanner with kProtocol has found.
[[nodiscard]] std::span<const std::uint8_t> body_of(std::span<const std::uint8_t> frame);

/// Returns the frame around a body, as the robot sends it.
/// @pre  The body has at most kLongestBody bytes.
[[nodiscard]] StreamFrame make_frame(std::span<const std::uint8_t> body);

}  // namespace orca::hw::create2
