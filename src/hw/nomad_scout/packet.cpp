// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/nomad_scout/packet.hpp"

#include "orca/hw/framing/checksums.hpp"

namespace orca::hw::nomad_scout {
namespace {

using Kind = framing::Finding::Kind;

constexpr std::uint8_t kStart = 0x01;
constexpr std::uint8_t kEnd = 0x5C;
constexpr std::size_t kHeaderSize = 4;     // start, length, type
constexpr std::size_t kTrailerSize = 2;    // sum, end
constexpr std::size_t kAroundPayload = 2;  // what the length counts beside the payload: type and sum
constexpr std::size_t kAroundLength = 4;   // what it does not count: start, length, end

}  // namespace

framing::Finding look(std::span<const std::uint8_t> bytes) {
  if (bytes[0] != kStart) return {};
  if (bytes.size() < 3) return {Kind::need_more};
  const std::size_t length = bytes[1];
  if (bytes[2] != 0 || length < kAroundPayload) return {};
  const std::size_t size = length + kAroundLength;
  if (bytes.size() < size) return {Kind::need_more};
  if (bytes[size - 1] != kEnd) return {};
  if (bytes[size - 2] != framing::sum_of_bytes(bytes.first(size - kTrailerSize))) return {Kind::bad_checksum};
  return {Kind::frame, size};
}

Packet make_packet(Type type, std::span<const std::uint8_t> payload) {
  Packet packet;
  packet.u8(kStart)
      .u16(static_cast<unsigned>(payload.size() + kAroundPayload))
      .u8(static_cast<unsigned>(type));
  packet.append(payload);
  packet.u8(framing::sum_of_bytes(packet.view())).u8(kEnd);
  return packet;
}

Message message_of(std::span<const std::uint8_t> packet) {
  return {static_cast<Type>(packet[kHeaderSize - 1]),
          packet.first(packet.size() - kTrailerSize).subspan(kHeaderSize)};
}

}  // namespace orca::hw::nomad_scout
