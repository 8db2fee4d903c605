// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace orca::xml {

// A character that looks like a blank and is none in XML. Word processors and web pages put it in.
struct OddBlank {
  std::size_t size;  // [bytes]
  std::string name;  // for people: "a no-break space (U+00A0)"
};

// Returns the odd blank that the text begins with, if it does.
std::optional<OddBlank> odd_blank(std::string_view text);

}  // namespace orca::xml
