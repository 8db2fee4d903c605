// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/xr4000/frame.hpp"

#include "orca/hw/framing/byte_reader.hpp"
#include "orca/hw/framing/checksums.hpp"

namespace orca::hw::xr4000 {
namespace {

using Kind = framing::Finding::Kind;

constexpr std::uint8_t kSync0 = 0x58;
constexpr std::uint8_t kSync1 = 0x52;
constexpr std::size_t kSyncSize = 2;
constexpr std::size_t kHeaderSize = 5;  // sync, length, type
constexpr std::size_t kCrcSize = 2;

// Of all between sync and checksum.
std::uint16_t crc_of(std::span<const std::uint8_t> frame) {
  return framing::crc_ccitt(frame.first(frame.size() - kCrcSize).subspan(kSyncSize));
}

}  // namespace

framing::Finding look(std::span<const std::uint8_t> bytes) {
  if (bytes[0] != kSync0) return {};
  if (bytes.size() > 1 && bytes[1] != kSync1) return {};
  if (bytes.size() < kHeaderSize) return {Kind::need_more};
  const std::size_t length = framing::ByteReader(bytes.subspan(kSyncSize)).u16();
  if (length > kLongestPayload) return {};
  const std::size_t size = kHeaderSize + length + kCrcSize;
  if (bytes.size() < size) return {Kind::need_more};
  const auto frame = bytes.first(size);
  if (framing::ByteReader(frame.last(kCrcSize)).u16() != crc_of(frame)) return {Kind::bad_checksum};
  return {Kind::frame, size};
}

Frame make_frame(const Message& message) {
  Frame frame;
  frame.u8(kSync0).u8(kSync1).u16(static_cast<unsigned>(message.payload.size()));
  frame.u8(static_cast<unsigned>(message.type) | (message.is_answer ? kAnswerBit : 0U));
  frame.append(message.payload);
  frame.u16(framing::crc_ccitt(frame.view().subspan(kSyncSize)));
  return frame;
}

Message message_of(std::span<const std::uint8_t> frame) {
  const unsigned type = frame[kHeaderSize - 1];
  return {static_cast<Type>(type & ~unsigned{kAnswerBit}), (type & kAnswerBit) != 0,
          frame.first(frame.size() - kCrcSize).subspan(kHeaderSize)};
}

}  // namespace orca::hw::xr4000
