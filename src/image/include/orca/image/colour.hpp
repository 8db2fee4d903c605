// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string_view>

#include "orca/base/result.hpp"

namespace orca {

/// A colour of the space sRGB, of which each part is between 0 and 255.
struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  friend bool operator==(const Colour&, const Colour&) = default;
};

/// Reads a colour as web pages write it, with two hexadecimal digits for each part: "#ff7a00".
/// @errors  invalid_argument: it is none.
/// @thread  pure function; any thread.
[[nodiscard]] Result<Colour> parse_colour(std::string_view text);

}  // namespace orca
