// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "orca/hw/framing/scanner.hpp"
#include "orca/hw/framing/short_list.hpp"

/// The serial protocol of the Nomad Scout and Super Scout: bytes to values and back, without clock and I/O. The robot only
/// answers, one answer to each command. All its functions are pure; any thread.
/// @source  Nomadic Technologies, Nomad host protocol, as the robot's direct client speaks it.
namespace orca::hw::nomad_scout {

inline constexpr std::size_t kLongestPayload =
    253;  ///< [bytes] The high byte of the length is 0 in all packets.
inline constexpr std::size_t kLongestPacket = kLongestPayload + 6;  ///< [bytes]

/// A whole packet, ready to be sent.
using Packet = framing::FrameBytes<kLongestPacket>;

/// The type of a packet, of those that a driver needs. An answer has the type of its command, or is nak.
enum class Type : std::uint8_t {
  accelerations = 1,      ///< AC
  drive = 5,              ///< VM
  get_state = 7,          ///< GS
  nak = 8,                ///< From the robot: not understood.
  stop = 9,               ///< ST
  limp = 10,              ///< LP
  configure_sonars = 15,  ///< CONF_SN
  set_watchdog = 18,      ///< CONF_TM
};

/// A packet taken apart. It refers to the bytes of the packet.
struct Message {
  Type type = Type::nak;  ///< May be one that is not listed.
  std::span<const std::uint8_t> payload{};
};

/// Recognises a packet at the first of these bytes: 01, length, type, payload, sum, 5C.
[[nodiscard]] framing::Finding look(std::span<const std::uint8_t> bytes);

/// The framing of both directions, for a framing::Scanner. When an answer has timed out, call its give_up().
inline constexpr framing::Protocol kProtocol{.look = look, .longest = kLongestPacket};

/// Returns the packet around a payload.
/// @pre  The payload has at most kLongestPayload bytes.
[[nodiscard]] Packet make_packet(Type type, std::span<const std::uint8_t> payload = {});

/// @pre  `packet` is a frame that a scanner with kProtocol has found.
[[nodiscard]] Message message_of(std::span<const std::uint8_t> packet);

}  // namespace orca::hw::nomad_scout
