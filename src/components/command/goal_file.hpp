// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::command {

/// A line of a file of goals.
struct GoalLine {
  std::string text;
  std::string place;  ///< For messages: "FILE:LINE:1".
};

/// Reads a file of goals, without its empty lines and comments.
/// @errors  those of read_input_file(); invalid_argument if it has more than 1 MB.
[[nodiscard]] Result<std::vector<GoalLine>> read_goal_file(const std::string& path);

}  // namespace orca::command
