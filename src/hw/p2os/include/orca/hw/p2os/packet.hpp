// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "orca/hw/framing/scanner.hpp"
#include "orca/hw/framing/short_list.hpp"

/// The serial protocol of Pioneer robots, P2OS and ARCOS: bytes to values and back, without clock and I/O.
/// All its functions are pure; any thread.
/// @source  Pioneer 2 operations manual, chapter "Client commands and the server information packet".
namespace orca::hw::p2os {

inline constexpr std::size_t kLongestBody = 253;    ///< [bytes] that the length byte can tell of.
inline constexpr std::size_t kLongestPacket = 258;  ///< [bytes] header, length, body and checksum.

/// A whole packet, ready to be sent.
using Packet = framing::FrameBytes<kLongestPacket>;

/// The first byte of a packet from the robot, as far as the type is one of these. Others must be passed over.
enum class PacketType : std::uint8_t {
  sync0 = 0x00,    ///< Echo of SYNC0.
  sync1 = 0x01,    ///< Echo of SYNC1.
  sync2 = 0x02,    ///< Echo of SYNC2 with the robot's names: parse_identity().
  config = 0x20,   ///< Settings of the controller: parse_config().
  encoder = 0x90,  ///< Wheel encoders: parse_encoder().
  gyro = 0x98,     ///< Turn rates, just before a SIP: parse_gyro().
  aux1 = 0xB0,     ///< Bytes from the first auxiliary port.
  aux2 = 0xB8,     ///< Bytes from the second one.
  io = 0xF0,       ///< Digital and analog ports: parse_io().
  sync_lost =
      0xFF,  ///< The robot awaits another step of the handshake, or was reset: begin again with SYNC0.
};

/// Recognises a packet at the first of these bytes: FA FB, length, body, checksum with its high byte first.
[[nodiscard]] framing::Finding look(std::span<const std::uint8_t> bytes);

/// The framing of both directions, for a framing::Scanner.
inline constexpr framing::Protocol kProtocol{.look = look, .longest = kLongestPacket};

/// Returns the packet around a body.
/// @pre  The body has 1 to kLongestBody bytes.
[[nodiscard]] Packet make_packet(std::span<const std::uint8_t> body);

/// Returns what lies between length and checksum: the type or the command, and what belongs to it.
/// @pre  `packet` is a frame that a scanner with kProtocol has found.
[[nodiscard]] std::span<const std::uint8_t> body_of(std::span<const std::uint8_t> packet);

}  // namespace orca::hw::p2os
