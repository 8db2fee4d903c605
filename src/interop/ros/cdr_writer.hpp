// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace orca::ros {

/// A writer of XCDR1, little-endian, with the encapsulation header of ROS in front.
class CdrWriter {
 public:
  CdrWriter() : bytes_{std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}} {}

  void put(std::unsigned_integral auto number) {
    align(sizeof number);
    for (std::size_t i = 0; i < sizeof number; ++i)
      bytes_.push_back(static_cast<std::byte>(static_cast<std::uint64_t>(number) >> (8 * i)));
  }
  void put(bool flag) { put(static_cast<std::uint8_t>(flag)); }
  void put(std::signed_integral auto number) {
    put(static_cast<std::make_unsigned_t<decltype(number)>>(number));
  }
  void put(double number) { put(std::bit_cast<std::uint64_t>(number)); }
  void put(float number) { put(std::bit_cast<std::uint32_t>(number)); }
  void put(std::string_view text) {
    put(static_cast<std::uint32_t>(text.size() + 1));
    append(std::as_bytes(std::span(text)));
    bytes_.push_back(std::byte{0});
  }
  void put_count(std::size_t count) { put(static_cast<std::uint32_t>(count)); }
  void append(std::span<const std::byte> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }

  [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  static constexpr std::size_t kHead = 4;  // [bytes] alignment counts after them
  void align(std::size_t size) {
    while ((bytes_.size() - kHead) % size != 0) bytes_.push_back(std::byte{0});
  }

  std::vector<std::byte> bytes_;
};

}  // namespace orca::ros
