// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/p2os/packet.hpp"

#include "orca/hw/framing/byte_reader.hpp"
#include "orca/hw/framing/checksums.hpp"

namespace orca::hw::p2os {
namespace {

using Kind = framing::Finding::Kind;

constexpr std::uint8_t kHeader[] = {0xFA, 0xFB};
constexpr std::size_t kBodyBegin = 3;
constexpr std::size_t kChecksumSize = 2;

}  // namespace

framing::Finding look(std::span<const std::uint8_t> bytes) {
  for (std::size_t i = 0; i < sizeof kHeader; ++i) {
    if (i == bytes.size()) return {Kind::need_more};
    if (bytes[i] != kHeader[i]) return {};
  }
  if (bytes.size() < kBodyBegin) return {Kind::need_more};
  const std::size_t count = bytes[2];  // of the bytes that follow
  if (count <= kChecksumSize) return {};
  if (bytes.size() < kBodyBegin + count) return {Kind::need_more};
  const std::size_t end = kBodyBegin + count - kChecksumSize;
  const unsigned sent = bytes[end] * 256U + bytes[end + 1];
  if (sent != framing::sum_of_words(bytes.first(end).subspan(kBodyBegin))) return {Kind::bad_checksum};
  return {Kind::frame, kBodyBegin + count};
}

Packet make_packet(std::span<const std::uint8_t> body) {
  Packet packet;
  const unsigned sum = framing::sum_of_words(body);
  packet.append(kHeader).u8(static_cast<unsigned>(body.size() + kChecksumSize)).append(body);
  packet.u8(sum >> 8).u8(sum);
  return packet;
}

std::span<const std::uint8_t> body_of(std::span<const std::uint8_t> packet) {
  return packet.first(packet.size() - kChecksumSize).subspan(kBodyBegin);
}

std::optional<int> sync_step(std::span<const std::uint8_t> body) {
  if (body.empty() || body[0] > 2) return std::nullopt;
  return body[0];
}

std::optional<Identity> parse_identity(std::span<const std::uint8_t> body) {
  if (sync_step(body) != 2) return std::nullopt;
  framing::ByteReader reader(body.subspan(1));
  Identity identity;
  identity.name = reader.text_to_zero();
  identity.robot_class = reader.text_to_zero();
  identity.subclass = reader.text_to_zero();
  return identity;
}

}  // namespace orca::hw::p2os
