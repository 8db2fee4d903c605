// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cctype>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "orca/hw/player/message.hpp"
#include "orca/hw/player/payload.hpp"

/// Bytes in tests of the Player protocol.
namespace orca::hw::player::test {

using Bytes = std::vector<std::uint8_t>;

/// Returns the bytes of e.g. "00000001 3F800000"; blanks and bars mean nothing.
[[nodiscard]] inline Bytes words(std::string_view text) {
  std::string digits;
  for (const char c : text)
    if (std::isxdigit(static_cast<unsigned char>(c)) != 0) digits += c;
  Bytes bytes;
  for (std::size_t i = 0; i < digits.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(digits.substr(i, 2), nullptr, 16)));
  return bytes;
}

/// Returns whether a payload has those bytes, and they have its value.
template <class Payload>
[[nodiscard]] bool agree(const Payload& payload, const Bytes& bytes) {
  const auto decoded = decode<Payload>(bytes);
  return encode(payload) == bytes && decoded.has_value() && *decoded == payload;
}

/// Returns the error's text, or nothing if there is none.
template <class T>
[[nodiscard]] std::string error_of(const Result<T>& result) {
  return result ? std::string() : result.error().text();
}

/// The address of a device of a server at 127.0.0.1, port 16665, as captured.
[[nodiscard]] inline Address captured(Interface interface) { return {0x0100007F, 0x4119, interface, 0}; }

}  // namespace orca::hw::player::test
