// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/text.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <vector>

namespace orca {

namespace {

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

// A character of a text in UTF-8; a byte that belongs to none has size 1 and no code point.
struct Character {
  std::size_t size = 1;
  std::optional<std::uint32_t> code_point;
};

// Takes a text that is not empty.
Character first_character(std::string_view text) {
  constexpr std::array<std::uint32_t, 5> kSmallest{0, 0, 0x80, 0x800, 0x10000};  // by size; less is overlong
  const auto lead = static_cast<unsigned char>(text.front());
  if (lead < 0x80) return {1, lead};
  const std::size_t size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : lead >= 0xC0 ? 2 : 0;
  if (size == 0 || size > text.size() || lead > 0xF4) return {};
  std::uint32_t value = lead & (0x7FU >> size);
  for (const char c : text.substr(1, size - 1)) {
    if (!continues_character(c)) return {};
    value = value << 6U | (static_cast<unsigned char>(c) & 0x3FU);
  }
  const bool surrogate = value >= 0xD800 && value <= 0xDFFF;
  if (value < kSmallest[size] || value > 0x10FFFF || surrogate) return {};
  return {size, value};
}

bool is_obeyed(std::uint32_t c) {
  const bool control = c < 0x20 || (c >= 0x7F && c <= 0x9F);
  const bool separates_lines = c == 0x2028 || c == 0x2029;
  const bool turns_direction = (c >= 0x202A && c <= 0x202E) || (c >= 0x2066 && c <= 0x2069) || c == 0x200E ||
                               c == 0x200F || c == 0x061C;
  return control || separates_lines || turns_direction;
}

std::string hex(char kind, int digits, std::uint32_t value) {
  std::array<char, 12> text{};
  std::snprintf(text.data(), text.size(), "\\%c%0*x", kind, digits, value);
  return text.data();
}

std::string escape_sequence(std::uint32_t c) {
  switch (c) {
    case '\n': return "\\n";
    case '\r': return "\\r";
    case '\t': return "\\t";
    default: return c < 0x80 ? hex('x', 2, c) : hex('u', 4, c);
  }
}

}  // namespace

std::string shortened(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  std::size_t head = most / 2;
  std::size_t tail = text.size() - most / 2;
  while (head > 0 && continues_character(text[head])) --head;
  while (tail < text.size() && continues_character(text[tail])) ++tail;
  return std::string(text.substr(0, head)) + "...(" + std::to_string(text.size()) + " bytes)..." +
         std::string(text.substr(tail));
}

std::string printable(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const Character next = first_character(text.substr(at));
    if (!next.code_point) {
      result += hex('x', 2, static_cast<unsigned char>(text[at]));
    } else if (is_obeyed(*next.code_point)) {
      result += escape_sequence(*next.code_point);
    } else {
      result += text.substr(at, next.size);
    }
    at += next.size;
  }
  return result;
}

std::string fitting(std::string_view text, std::size_t columns) {
  constexpr std::uint32_t kFirstWide = 0x1100;
  constexpr std::string_view kMore = "...";
  std::size_t used = 0;
  std::size_t at = 0;
  std::size_t end = 0;  // of what fits together with kMore
  while (at < text.size()) {
    const Character next = first_character(text.substr(at));
    used += next.code_point.value_or(0) >= kFirstWide ? 2 : 1;
    if (used > columns) return std::string(text.substr(0, end)) + std::string(kMore.substr(0, columns));
    at += next.size;
    if (used + kMore.size() <= columns) end = at;
  }
  return std::string(text);
}

std::string in_shell_quotes(std::string_view text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kMost = 300;
  return "\"" + shortened(text, kMost) + "\"";
}

std::string joined(std::span<const std::string> parts, std::string_view separator) {
  std::string result;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) result += separator;
    result += parts[i];
  }
  return result;
}

std::string listed(std::span<const std::string> names, std::size_t most) {
  if (names.empty()) return "nothing";
  constexpr std::size_t kMost = 200;
  std::vector<std::string> first;
  for (const std::string& name : names.first(std::min(names.size(), most)))
    first.push_back(shortened(name, kMost));
  const std::string shown = joined(first, ", ");
  return names.size() <= most ? shown : shown + " and " + std::to_string(names.size() - most) + " more";
}

std::string seconds_text(Duration time) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g s", to_seconds(time));
  return text;
}

}  // namespace orca
