// SPDX-License-Identifier: LGPL-3.0-or-later
#include "processes/line_splitter.hpp"

#include <algorithm>
#include <utility>

#include "orca/base/text.hpp"

namespace orca::supervisor {

std::vector<std::string> LineSplitter::add(std::string_view printed) {
  std::vector<std::string> lines;
  for (auto end = printed.find('\n'); end != std::string_view::npos; end = printed.find('\n')) {
    append(printed.substr(0, end));
    lines.push_back(take());
    printed.remove_prefix(end + 1);
  }
  append(printed);
  return lines;
}

std::vector<std::string> LineSplitter::finish() {
  if (line_.empty()) return {};
  return {take()};
}

void LineSplitter::append(std::string_view part) {
  const std::size_t count = std::min(part.size(), kLongest - line_.size());
  line_ += part.substr(0, count);
  if (count < part.size()) is_cut_ = true;
}

std::string LineSplitter::take() {
  std::string line = std::exchange(line_, {});
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return printable(line) + (std::exchange(is_cut_, false) ? "..." : "");
}

}  // namespace orca::supervisor
