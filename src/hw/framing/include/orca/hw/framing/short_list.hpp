// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>

namespace orca::hw::framing {

/// A list of at most Capacity elements, kept in place: it never takes memory from the heap.
///
/// A plain value.
/// @errors  std::length_error from whatever would make it longer: a broken precondition.
template <class T, std::size_t Capacity>
class ShortList {
 public:
  void push_back(const T& element) {
    if (size_ == Capacity) throw std::length_error("ShortList: no room for another element");
    elements_[size_++] = element;
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] static constexpr std::size_t capacity() { return Capacity; }
  /// @pre  index < size()
  [[nodiscard]] const T& operator[](std::size_t index) const { return elements_[index]; }
  [[nodiscard]] T& operator[](std::size_t index) { return elements_[index]; }
  [[nodiscard]] const T* begin() const { return elements_.data(); }
  [[nodiscard]] const T* end() const { return elements_.data() + size_; }
  [[nodiscard]] std::span<const T> view() const { return {elements_.data(), size_}; }
  friend bool operator==(const ShortList& a, const ShortList& b) { return std::ranges::equal(a, b); }

 private:
  std::array<T, Capacity> elements_{};
  std::size_t size_ = 0;
};

/// Bytes of a frame that is being written. Numbers are written with their low byte first.
///
/// A plain value.
template <std::size_t Capacity>
class FrameBytes : public ShortList<std::uint8_t, Capacity> {
 public:
  FrameBytes& u8(unsigned value) {
    this->push_back(static_cast<std::uint8_t>(value & 0xFF));
    return *this;
  }
  FrameBytes& u16(unsigned value) { return u8(value).u8(value >> 8); }
  FrameBytes& u32(std::uint32_t value) { return u16(value & 0xFFFF).u16(value >> 16); }
  FrameBytes& append(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) u8(byte);
    return *this;
  }
};

}  // namespace orca::hw::framing
