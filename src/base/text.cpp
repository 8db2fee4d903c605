// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/text.hpp"

#include <algorithm>

namespace orca {

std::string in_quotes(std::string_view text) { return "\"" + std::string(text) + "\""; }

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
  const std::string shown = joined(names.first(std::min(names.size(), most)), ", ");
  return names.size() <= most ? shown : shown + " and " + std::to_string(names.size() - most) + " more";
}

}  // namespace orca
