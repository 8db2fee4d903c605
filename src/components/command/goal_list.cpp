// SPDX-License-Identifier: LGPL-3.0-or-later
#include "goal_list.hpp"

#include <sstream>

#include "orca/base/input_file.hpp"

namespace orca::command {
namespace {

constexpr std::size_t kMaxBytes = 1'000'000;

}  // namespace

Result<std::vector<GoalLine>> read_goal_file(const std::string& path) {
  const Result<std::string> text = read_input_file(path, kMaxBytes);
  if (!text) return fail(text.error().code, "cannot read the file of goals: " + text.error().message, path);
  if (text->size() == kMaxBytes)
    return fail(Code::invalid_argument, "the file of goals has more than 1 MB, which is the limit", path);
  std::istringstream file(*text);
  std::vector<GoalLine> lines;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos || line.front() == '#') continue;
    lines.push_back({line, path + ":" + std::to_string(number) + ":1"});
  }
  return lines;
}

}  // namespace orca::command
