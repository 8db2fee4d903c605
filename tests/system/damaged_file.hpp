// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace orca::test {

/// One edit that makes a good file a bad one.
struct Damage {
  std::string from;                ///< Occurs in the good file; the first occurrence is replaced.
  std::string to;                  ///<
  std::string at;                  ///< Text whose first character the error must point at, within `to`.
  std::vector<std::string> hints;  ///< What the error must say.
};

/// The text after an edit; fails the test if there is nothing to replace.
inline std::string damaged(std::string text, const Damage& damage) {
  const auto place = text.find(damage.from);
  if (place == std::string::npos) throw std::runtime_error("the good file does not contain " + damage.from);
  return text.replace(place, damage.from.size(), damage.to);
}

/// "12:7" for where `at` stands, at or after the first occurrence of `after`. Lines and columns count from 1.
inline std::string line_and_column(std::string_view text, std::string_view after, std::string_view at) {
  const auto place = text.find(at, text.find(after));
  if (place == std::string_view::npos) throw std::runtime_error("no " + std::string(at) + " in the text");
  const auto before = text.substr(0, place);
  const auto line = std::ranges::count(before, '\n') + 1;
  const auto line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  return std::to_string(line) + ":" + std::to_string(place - line_start + 1);
}

}  // namespace orca::test
