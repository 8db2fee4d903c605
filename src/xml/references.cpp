// SPDX-License-Identifier: LGPL-3.0-or-later
#include "references.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

#include "codes.hpp"

namespace orca::xml {
namespace {

constexpr std::array<std::string_view, 5> kPredefined{"amp", "lt", "gt", "apos", "quot"};

// Long enough for every legal reference; in anything longer, the '&' stands for itself.
constexpr std::size_t kLongest = 40;

bool is_xml_character(std::uint32_t c) {
  if (c < 0x20) return c == '\t' || c == '\n' || c == '\r';
  if (c >= 0xD800 && c <= 0xDFFF) return false;
  return c <= 0x10FFFF && c != 0xFFFE && c != 0xFFFF;
}

// Takes in `digits` the text between "&#" and ';'.
bool is_character_number(std::string_view digits) {
  const bool hex = digits.starts_with('x');
  if (hex) digits.remove_prefix(1);
  std::uint32_t value = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, problem] = std::from_chars(digits.data(), end, value, hex ? 16 : 10);
  return problem == std::errc{} && stop == end && is_xml_character(value);
}

bool is_name(std::string_view text) {
  const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !text.empty() && std::ranges::all_of(text, fits);
}

std::optional<BadReference> judge(std::string_view after_ampersand, std::size_t offset) {
  const std::size_t end = after_ampersand.substr(0, kLongest).find(';');
  const std::string_view name = after_ampersand.substr(0, end == std::string_view::npos ? 0 : end);
  if (name.starts_with('#')) {
    if (is_character_number(name.substr(1))) return std::nullopt;
    return BadReference{offset, codes::kCharacterReference,
                        "the character reference &" + std::string(name) + "; names no character of XML"};
  }
  if (!is_name(name)) return BadReference{offset, codes::kEntity, "a '&' for itself is written &amp;"};
  if (std::ranges::find(kPredefined, name) != kPredefined.end()) return std::nullopt;
  return BadReference{offset, codes::kEntity,
                      "the entity &" + std::string(name) +
                          "; is not defined; there are &amp; &lt; &gt; &apos; &quot; and &#number;"};
}

}  // namespace

std::optional<BadReference> find_bad_reference(std::string_view text, std::size_t from) {
  for (std::size_t at = text.find('&', from); at != std::string_view::npos; at = text.find('&', at + 1)) {
    if (auto bad = judge(text.substr(at + 1), at)) return bad;
  }
  return std::nullopt;
}

}  // namespace orca::xml
