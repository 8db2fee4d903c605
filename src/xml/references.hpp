// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace orca::xml {

// A '&' that does not start one of the references that XML has without a DTD.
struct BadReference {
  std::size_t offset;  // of the '&' in the text
  const char* code;
  std::string message;
};

// Returns the first bad reference at or after `from`.
std::optional<BadReference> find_bad_reference(std::string_view text, std::size_t from);

}  // namespace orca::xml
