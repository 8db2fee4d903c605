// SPDX-License-Identifier: GPL-3.0-or-later
#include "trace_file.hpp"

#include <algorithm>
#include <set>
#include <sstream>

#include "deployer.hpp"
#include "temp_folder.hpp"

namespace orca::test {

bool TraceLine::is(std::string_view wanted, const std::vector<std::string>& first_words) const {
  return event == wanted && words.size() >= first_words.size() &&
         std::equal(first_words.begin(), first_words.end(), words.begin());
}

TraceFile::TraceFile(const std::string& path) {
  for (const std::string& text : split_lines(read_text(path))) {
    std::istringstream in(text);
    TraceLine line;
    in >> line.time >> line.event;
    for (std::string word; in >> word;) line.words.push_back(word);
    lines_.push_back(std::move(line));
  }
}

std::size_t TraceFile::find(std::string_view event, const std::vector<std::string>& words,
                            std::size_t from) const {
  for (std::size_t i = from; i < lines_.size(); ++i)
    if (lines_[i].is(event, words)) return i;
  return kNever;
}

std::string TraceFile::state_before(std::string_view name, std::size_t end) const {
  std::string state;
  for (std::size_t i = 0; i < std::min(end, lines_.size()); ++i)
    if (lines_[i].is("state", {std::string(name)})) state = lines_[i].words.back();
  return state;
}

std::vector<std::string> TraceFile::open_connections(std::size_t end) const {
  std::multiset<std::string> open;
  for (std::size_t i = 0; i < std::min(end, lines_.size()); ++i) {
    const TraceLine& line = lines_[i];
    if (line.words.size() < 2) continue;
    const std::string both = line.words[0] + " " + line.words[1];
    if (line.event == "connect") open.insert(both);
    if (line.event == "disconnect" && open.contains(both)) open.erase(open.find(both));
  }
  return {open.begin(), open.end()};
}

}  // namespace orca::test
