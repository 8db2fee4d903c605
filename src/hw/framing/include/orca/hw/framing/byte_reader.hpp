// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace orca::hw::framing {

/// A reader of the fields of a frame, one after the other. Numbers have their low byte first. What lies behind the
/// last byte reads as zeros, so that a shorter frame of an older firmware needs no case of its own.
///
/// It refers to the bytes and does not copy them. Thread contract: not synchronised.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  [[nodiscard]] std::size_t remaining() const { return bytes_.size(); }
  std::uint8_t u8();
  std::uint16_t u16();
  std::uint32_t u32();
  /// Signed numbers are in two's complement.
  std::int8_t s8() { return static_cast<std::int8_t>(u8()); }
  std::int16_t s16() { return static_cast<std::int16_t>(u16()); }
  std::int32_t s32() { return static_cast<std::int32_t>(u32()); }

  /// Returns the next `count` bytes, or those that are left.
  std::span<const std::uint8_t> bytes(std::size_t count);
  /// Returns the next `count` bytes, or those that are left, as characters.
  std::string_view text(std::size_t count);
  /// Returns the text up to the next zero byte, which is passed over, or up to the end.
  std::string_view text_to_zero();

 private:
  std::span<const std::uint8_t> bytes_;
};

}  // namespace orca::hw::framing
