// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

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

/// The first byte of a packet from the robot, as far as a driver needs to tell it; see also is_sip() and sync_step(). Others must be passed over.
enum class PacketType : std::uint8_t {
  config = 0x20,  ///< Settings of the controller: parse_config().
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

/// What a robot says of itself in answer to SYNC2.
///
/// A plain value.
struct Identity {
  std::string name;         ///< Given by its owner, e.g. "Pioneer2".
  std::string robot_class;  ///< e.g. "Pioneer".
  std::string subclass;     ///< The model, e.g. "p2dx": see choose_model().
  friend bool operator==(const Identity&, const Identity&) = default;
};

/// Returns the step of the handshake that a body answers, 0 to 2; nothing if it is no answer.
[[nodiscard]] std::optional<int> sync_step(std::span<const std::uint8_t> body);

/// Reads the answer to SYNC2. Texts that are missing are empty.
/// @return  nothing if the body is none.
[[nodiscard]] std::optional<Identity> parse_identity(std::span<const std::uint8_t> body);

}  // namespace orca::hw::p2os
