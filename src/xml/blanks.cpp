// SPDX-License-Identifier: LGPL-3.0-or-later
#include "blanks.hpp"

#include <array>
#include <cstdint>
#include <cstdio>

namespace orca::xml {
namespace {

constexpr std::uint32_t kNoBreakSpace = 0xA0;

// Returns the character of two or three bytes that the text begins with; 0 if it begins with another.
std::uint32_t two_or_three_bytes(std::string_view text, std::size_t& size) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  size = text.empty() || byte(0) < 0xC0 || byte(0) >= 0xF0 ? 0 : byte(0) < 0xE0 ? 2 : 3;
  if (size == 0 || text.size() < size) return 0;
  if (size == 2) return (byte(0) & 0x1FU) << 6U | (byte(1) & 0x3FU);
  return (byte(0) & 0x0FU) << 12U | (byte(1) & 0x3FU) << 6U | (byte(2) & 0x3FU);
}

bool looks_blank(std::uint32_t c) {
  if (c >= 0x2000 && c <= 0x200B) return true;
  constexpr std::array<std::uint32_t, 9> kOthers{0x85,   kNoBreakSpace, 0x1680, 0x2028, 0x2029,
                                                 0x202F, 0x205F,        0x3000, 0xFEFF};
  for (const std::uint32_t other : kOthers)
    if (c == other) return true;
  return false;
}

}  // namespace

std::optional<OddBlank> odd_blank(std::string_view text) {
  std::size_t size = 0;
  const std::uint32_t c = two_or_three_bytes(text, size);
  if (!looks_blank(c)) return std::nullopt;
  std::array<char, 16> number{};
  std::snprintf(number.data(), number.size(), " (U+%04X)", c);
  return OddBlank{size, (c == kNoBreakSpace ? "a no-break space" : "a blank of another kind") +
                            std::string(number.data())};
}

}  // namespace orca::xml
