// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/hw/framing/scanner.hpp"

/// A protocol made for tests of the scanner: A5, length of the body (1 to 60), body, sum of the body in 16 bits.
namespace orca::hw::toy {

using Bytes = std::vector<std::uint8_t>;

inline constexpr std::uint8_t kStart = 0xA5;
inline constexpr std::size_t kLongestBody = 60;

/// The sum is weighted by position, so that exchanged bytes change it.
[[nodiscard]] inline unsigned sum(std::span<const std::uint8_t> body) {
  unsigned sum = 1;
  for (const std::uint8_t byte : body) sum = sum * 251U + byte;
  return sum & 0xFFFFU;
}

[[nodiscard]] inline framing::Finding look(std::span<const std::uint8_t> bytes) {
  using Kind = framing::Finding::Kind;
  if (bytes[0] != kStart) return {};
  if (bytes.size() < 2) return {Kind::need_more};
  const std::size_t length = bytes[1];
  if (length == 0 || length > kLongestBody) return {};
  if (bytes.size() < length + 4) return {Kind::need_more};
  const unsigned sent = bytes[length + 2] * 256U + bytes[length + 3];
  return sum(bytes.subspan(2, length)) == sent ? framing::Finding{Kind::frame, length + 4}
                                               : framing::Finding{Kind::bad_checksum};
}

inline constexpr framing::Protocol kProtocol{.look = look, .longest = kLongestBody + 4};

[[nodiscard]] inline Bytes frame_of(const Bytes& body) {
  Bytes frame{kStart, static_cast<std::uint8_t>(body.size())};
  frame.insert(frame.end(), body.begin(), body.end());
  frame.push_back(static_cast<std::uint8_t>(sum(body) >> 8));
  frame.push_back(static_cast<std::uint8_t>(sum(body) & 0xFFU));
  return frame;
}

/// Returns a whole number in [low, high].
[[nodiscard]] inline std::size_t number(RandomStream& random, std::size_t low, std::size_t high) {
  return low + random() % (high - low + 1);
}

[[nodiscard]] inline Bytes noise(RandomStream& random, std::size_t size) {
  Bytes bytes(size);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random() & 0xFF);
  return bytes;
}

}  // namespace orca::hw::toy
