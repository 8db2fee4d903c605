// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/sick_lms/telegram.hpp"

#include "orca/hw/framing/checksums.hpp"

namespace orca::hw::sick_lms {
namespace {

using Kind = framing::Finding::Kind;

constexpr std::uint8_t kStart = 0x02;
constexpr std::uint8_t kToLaser = 0x00;
constexpr std::uint8_t kToHost = 0x80;
constexpr std::uint8_t kAck = 0x06;
constexpr std::uint8_t kNak = 0x15;
constexpr std::size_t kHeaderSize = 4;
constexpr std::size_t kCheckSize = 2;

// A start byte alone proves nothing, since it occurs in data: address, length and check word must fit too.
framing::Finding look(std::span<const std::uint8_t> bytes, std::uint8_t address, std::size_t shortest) {
  if (bytes[0] != kStart) return {};
  if (bytes.size() > 1 && bytes[1] != address) return {};
  if (bytes.size() < kHeaderSize) return {Kind::need_more};
  const std::size_t length = bytes[2] + std::size_t{256} * bytes[3];
  if (length < shortest || length > kLongestPayload) return {};
  const std::size_t end = kHeaderSize + length;
  if (bytes.size() < end + kCheckSize) return {Kind::need_more};
  const unsigned sent = bytes[end] + 256U * bytes[end + 1];
  if (sent != framing::crc_of_pairs(bytes.first(end))) return {Kind::bad_checksum};
  return {Kind::frame, end + kCheckSize};
}

}  // namespace

framing::Finding look_from_laser(std::span<const std::uint8_t> bytes) {
  if (bytes[0] == kAck || bytes[0] == kNak) return {Kind::frame, 1};
  return look(bytes, kToHost, 2);  // code and status
}

framing::Finding look_from_host(std::span<const std::uint8_t> bytes) { return look(bytes, kToLaser, 1); }

Heard heard(std::span<const std::uint8_t> frame) {
  if (frame.size() > 1) return Heard::telegram;
  return frame[0] == kAck ? Heard::ack : Heard::nak;
}

std::span<const std::uint8_t> payload_of(std::span<const std::uint8_t> telegram) {
  return telegram.first(telegram.size() - kCheckSize).subspan(kHeaderSize);
}

Telegram make_request(std::span<const std::uint8_t> payload) {
  Telegram telegram;
  telegram.u8(kStart).u8(kToLaser).u16(static_cast<unsigned>(payload.size())).append(payload);
  telegram.u16(framing::crc_of_pairs(telegram.view()));
  return telegram;
}

}  // namespace orca::hw::sick_lms
