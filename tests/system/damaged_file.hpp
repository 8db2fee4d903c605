// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace orca::test {

/// One edit that makes a good file a bad one.
struct Damage {
  std::string from;                ///< Occurs in the good file; the first occurrence is replaced.
  std::string to;                  ///<
  std::string at;                  ///< Text whose first character the error must point at, within `to`.
  std::vector<std::string> hints;  ///< What the error must say.
};

/// A good text after an edit.
struct Damaged {
  std::string text;
  std::size_t place = 0;  ///< Where the edit begins.
};

/// Throws if there is nothing to replace.
inline Damaged damaged(std::string text, const Damage& damage) {
  const auto place = text.find(damage.from);
  if (place == std::string::npos) throw std::runtime_error("the good file does not contain " + damage.from);
  text.replace(place, damage.from.size(), damage.to);
  return {std::move(text), place};
}

/// "12:7" for the first `at` from `from` on. Lines and columns count from 1.
inline std::string line_and_column(std::string_view text, std::size_t from, std::string_view at) {
  const auto place = text.find(at, from);
  if (place == std::string_view::npos) throw std::runtime_error("no " + std::string(at) + " in the text");
  const auto before = text.substr(0, place);
  const auto line = std::ranges::count(before, '\n') + 1;
  const auto line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  return std::to_string(line) + ":" + std::to_string(place - line_start + 1);
}

}  // namespace orca::test
