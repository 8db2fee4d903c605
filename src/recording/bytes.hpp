// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "orca/recording/mcap.hpp"

namespace orca::recording {

using Bytes = std::vector<std::byte>;
using CountsByChannel = std::map<std::uint16_t, std::uint64_t>;

/// Appends a number, little-endian.
template <std::unsigned_integral T>
void put(Bytes& out, T number) {
  for (std::size_t i = 0; i < sizeof(T); ++i)
    out.push_back(static_cast<std::byte>(static_cast<std::uint64_t>(number) >> (8 * i)));
}
inline void put(Bytes& out, std::span<const std::byte> bytes) {
  out.insert(out.end(), bytes.begin(), bytes.end());
}
/// Appends a text with its length in front, as MCAP has it.
void put(Bytes& out, std::string_view text);
void put(Bytes& out, const Values& values);
void put(Bytes& out, const CountsByChannel& counts);
/// Appends several of these.
template <class First, class Second, class... More>
void put(Bytes& out, const First& first, const Second& second, const More&... more) {
  put(out, first);
  put(out, second);
  (put(out, more), ...);
}
/// Returns such values one after the other.
template <class... T>
Bytes encoded(const T&... values) {
  Bytes out;
  (put(out, values), ...);
  return out;
}

/// A reader of bytes that nobody vouches for. A value that is not there reads as 0 or empty, and is_good() is false from then
/// on.
class Cursor {
 public:
  explicit Cursor(std::span<const std::byte> bytes) : left_(bytes) {}

  template <std::unsigned_integral T>
  T number() {
    const std::span<const std::byte> bytes = take(sizeof(T));
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i)
      value |= std::to_integer<std::uint64_t>(bytes[i]) << (8 * i);
    return static_cast<T>(value);
  }
  /// Reads a value as put() appends it.
  template <std::unsigned_integral T>
  void get(T& value) {
    value = number<T>();
  }
  void get(std::string& text);
  void get(Values& values);
  void get(CountsByChannel& counts);
  /// Returns the next bytes, or none if there are not so many.
  std::span<const std::byte> take(std::uint64_t count);

  [[nodiscard]] std::span<const std::byte> left() const { return left_; }
  [[nodiscard]] bool is_good() const { return good_; }
  /// Returns whether everything was there, and nothing is left.
  [[nodiscard]] bool is_done() const { return good_ && left_.empty(); }

 private:
  std::span<const std::byte> left_;
  bool good_ = true;
};

/// Returns a structure whose members stand one after the other at the beginning of bytes; nothing if they are not all there.
template <class T, class... Member>
std::optional<T> read_members(std::span<const std::byte> bytes, Member T::*... members) {
  Cursor cursor(bytes);
  T value;
  (cursor.get(value.*members), ...);
  return cursor.is_good() ? std::optional(std::move(value)) : std::nullopt;
}

/// Returns the CRC-32 of bytes, with the polynomial of zlib.
[[nodiscard]] std::uint32_t crc_of(std::span<const std::byte> bytes);

}  // namespace orca::recording
