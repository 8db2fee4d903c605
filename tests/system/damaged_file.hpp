// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace orca::test {

/// An edit that turns a good file into a bad one.
struct Damage {
  std::string from;                ///< Text of the good file; its first occurrence is replaced.
  std::string to;                  ///< Replacement.
  std::string at;                  ///< Text whose first character the error must point at, within `to`.
  std::vector<std::string> hints;  ///< Words that the error must contain.
};

/// A text after an edit.
struct Damaged {
  std::string text;
  std::size_t place = 0;  ///< Where the edit begins.
};

/// Returns the text after the edit. Throws if there is nothing to replace.
inline Damaged damaged(std::string text, const Damage& damage) {
  const auto place = text.find(damage.from);
  if (place == std::string::npos) throw std::runtime_error("the good file does not contain " + damage.from);
  text.replace(place, damage.from.size(), damage.to);
  return {std::move(text), place};
}

/// Returns the position of the first `at` from `from` on, as "12:7". Lines and columns count from 1.
inline std::string line_and_column(std::string_view text, std::size_t from, std::string_view at) {
  const auto place = text.find(at, from);
  if (place == std::string_view::npos) throw std::runtime_error("no " + std::string(at) + " in the text");
  const auto before = text.substr(0, place);
  const auto line = std::ranges::count(before, '\n') + 1;
  const auto line_start = before.rfind('\n') + 1;  // npos + 1 is 0
  return std::to_string(line) + ":" + std::to_string(place - line_start + 1);
}

}  // namespace orca::test
