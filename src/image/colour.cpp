// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/image/colour.hpp"

#include <charconv>
#include <string>

namespace orca {

Result<Colour> parse_colour(std::string_view text) {
  constexpr std::size_t kLength = 7;
  std::uint32_t number = 0;
  const char* const end = text.data() + text.size();
  if (text.size() == kLength && text.front() == '#' && text[1] != '-') {
    const auto read = std::from_chars(text.data() + 1, end, number, 16);
    if (read.ec == std::errc{} && read.ptr == end)
      return Colour{static_cast<std::uint8_t>(number >> 16U), static_cast<std::uint8_t>(number >> 8U),
                    static_cast<std::uint8_t>(number)};
  }
  return fail(
      Code::invalid_argument,
      "\"" + std::string(text) +
          "\" is no colour; write # and two hexadecimal digits each of red, green and blue: \"#ff7a00\"");
}

}  // namespace orca
