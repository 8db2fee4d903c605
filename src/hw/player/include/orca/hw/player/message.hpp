// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"

/// The TCP protocol of Player 3.x in XDR: bytes to values and back, for clients and servers, without clock and I/O.
/// All its functions are pure; any thread.
/// @source  Player 3.1 server and its client library libplayerc.
namespace orca::hw::player {

inline constexpr std::size_t kHeaderSize = 40;                   ///< [bytes]
inline constexpr std::size_t kLongestMessage = 8 * 1024 * 1024;  ///< [bytes] header and payload.
inline constexpr std::size_t kLongestPayload = kLongestMessage - kHeaderSize;  ///< [bytes]

/// Kind of a device. Other codes occur and are kept as they are.
enum class Interface : std::uint32_t {
  player = 1,      ///< The server itself.
  power = 2,       ///< Batteries.
  position2d = 4,  ///< Mobile base in the plane.
  sonar = 5,       ///< Ring of sonars; deprecated in Player, but drivers still use it.
  laser = 6,       ///< Laser scanner; deprecated in Player, but drivers still use it.
  bumper = 14,     ///< Bumpers.
  ranger = 62,     ///< Range sensors of any kind; it replaces sonar and laser.
};

/// What a message is for.
enum class MessageType : std::uint32_t {
  data = 1,     ///< Server to client.
  command = 2,  ///< Client to server, without an answer.
  request = 3,  ///< Client to server; ack or nack answers it. An unknown device or subtype may get no answer.
  ack = 4,      ///< The answer to a request.
  synch = 5,    ///< End of a round of data in pull mode.
  nack = 6,     ///< The refusal of a request.
};

/// The device that a message is from or for. A plain value.
struct Address {
  std::uint32_t host = 0;   ///< IPv4 address, its first number in the low byte. A client may send 0.
  std::uint32_t robot = 0;  ///< TCP port of the device. A client may send 0.
  Interface interface = Interface::player;
  std::uint32_t index = 0;  ///< Counts devices of the same interface.
  friend bool operator==(const Address&, const Address&) = default;
};

/// What precedes each payload. A plain value.
struct Header {
  Address address{};
  MessageType type = MessageType::data;
  std::uint32_t subtype = 0;   ///< Its meaning depends on interface and type: see MessageId.
  double time = 0.0;           ///< [s] time stamp by the server's clock.
  std::uint32_t sequence = 0;  ///< An answer repeats that of its request. In a synch it means nothing.
  std::uint32_t size = 0;      ///< [bytes] of the payload.
  friend bool operator==(const Header&, const Header&) = default;
};

/// The identity of a message. The headers of the interfaces define a constant of each that Orca knows. The answer to
/// a request has its subtype too.
struct MessageId {
  Interface interface = Interface::player;
  MessageType type = MessageType::data;
  std::uint32_t subtype = 0;
  friend bool operator==(const MessageId&, const MessageId&) = default;
};

[[nodiscard]] inline MessageId id_of(const Header& header) {
  return {header.address.interface, header.type, header.subtype};
}

/// Returns a header for device `index`; host, robot, time and sequence are 0.
[[nodiscard]] inline Header header_for(const MessageId& id, std::uint32_t index = 0) {
  return {.address = {.interface = id.interface, .index = index}, .type = id.type, .subtype = id.subtype};
}

/// Returns the header of an answer: address, subtype and sequence are those of the request, by which clients find it.
/// @param type  MessageType::ack or nack.
[[nodiscard]] inline Header answer_to(const Header& request, MessageType type) {
  return {.address = request.address, .type = type, .subtype = request.subtype, .sequence = request.sequence};
}

[[nodiscard]] std::array<std::uint8_t, kHeaderSize> encode_header(const Header& header);

/// Reads the first kHeaderSize bytes.
/// @errors  data_loss if there are fewer, if the type is none of MessageType, or if the size exceeds kLongestPayload.
[[nodiscard]] Result<Header> decode_header(std::span<const std::uint8_t> bytes);

/// Returns a whole message, ready to be sent. The header's size is that of the payload, whatever `header` says.
/// @errors  invalid_argument if the payload exceeds kLongestPayload.
[[nodiscard]] Result<std::vector<std::uint8_t>> make_message(Header header,
                                                             std::span<const std::uint8_t> payload = {});

inline constexpr std::size_t kBannerSize = 32;  ///< [bytes]

/// Returns what a server sends first: "Player v." and the version, filled up with zero bytes.
/// @param version  e.g. "3.1.1-dev"; cut after 22 characters, so that a zero byte always ends it.
[[nodiscard]] std::array<std::uint8_t, kBannerSize> make_banner(std::string_view version);

/// Returns the version in a banner.
/// @param banner  The first kBannerSize bytes of the connection.
/// @errors  data_loss if there are fewer; invalid_argument if they do not begin like the banner of a Player server.
[[nodiscard]] Result<std::string> parse_banner(std::span<const std::uint8_t> banner);

}  // namespace orca::hw::player
