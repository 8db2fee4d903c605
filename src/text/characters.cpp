// SPDX-License-Identifier: LGPL-3.0-or-later
#include "characters.hpp"

#include <charconv>
#include <cstdint>

#include "codes.hpp"
#include "orca/xml/document.hpp"

namespace orca::text {
namespace {

constexpr std::string_view kDigits = "0123456789abcdef";

std::string as_byte(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return {'\\', 'x', kDigits[byte >> 4U], kDigits[byte & 0xFU]};
}

// Returns the byte that two hexadecimal digits mean.
std::optional<char> hexadecimal(std::string_view digits) {
  std::uint8_t byte = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, problem] = std::from_chars(digits.data(), end, byte, 16);
  if (digits.size() != 2 || problem != std::errc{} || stop != end) return std::nullopt;
  return static_cast<char>(byte);
}

}  // namespace

std::string with_backslashes(std::string_view bytes) {
  std::string text;
  while (!bytes.empty()) {
    const std::size_t size = xml::character_size(bytes);
    const std::size_t taken = size == 0 ? 1 : size;
    if (bytes.front() == '\\') text += '\\';
    text += size == 0 ? as_byte(bytes.front()) : std::string(bytes.substr(0, size));
    bytes.remove_prefix(taken);
  }
  return text;
}

Verdict without_backslashes(std::string_view text, std::string& bytes) {
  bytes.clear();
  for (std::size_t at = text.find('\\'); at != std::string_view::npos; at = text.find('\\')) {
    bytes += text.substr(0, at);
    text.remove_prefix(at + 1);
    const std::optional<char> byte = text.starts_with('x') ? hexadecimal(text.substr(1, 2)) : std::nullopt;
    if (!byte && !text.starts_with('\\')) {
      return Problem{codes::kBackslash,
                     "a backslash is written \\\\, any other byte \\x and two digits: \\x1b"};
    }
    bytes += byte.value_or('\\');
    text.remove_prefix(byte ? 3 : 1);
  }
  bytes += text;
  return {};
}

}  // namespace orca::text
