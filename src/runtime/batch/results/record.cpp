// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/record.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "orca/xml/number.hpp"

namespace orca::batch {
namespace {

constexpr std::array<std::pair<Ending, const char*>, 7> kEndings{{{Ending::success, "success"},
                                                                  {Ending::contact, "contact"},
                                                                  {Ending::goal_failed, "goal_failed"},
                                                                  {Ending::time_out, "time_out"},
                                                                  {Ending::failed, "failed"},
                                                                  {Ending::crash, "crash"},
                                                                  {Ending::hang, "hang"}}};
constexpr std::size_t kLinesBesideMeasures = 11;
constexpr std::string_view kMissing = "-";

template <class Number>
bool read_number(std::string_view text, Number& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size();
}

bool read_measures(std::span<const std::string_view> lines, Measures& measures) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i] == kMissing) continue;
    if (!read_number(lines[i], (measures.*all_measures()[i].value).emplace())) return false;
  }
  return true;
}

std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end + 1);
  }
  return lines;
}

}  // namespace

const char* name_of(Ending ending) {
  return std::ranges::find(kEndings, ending, &std::pair<Ending, const char*>::first)->second;
}

std::optional<Ending> ending_of(std::string_view name) {
  for (const auto& [ending, its_name] : kEndings)
    if (name == its_name) return ending;
  return std::nullopt;
}

std::string to_text(const Outcome& outcome) {
  std::string text;
  for (const std::string& line :
       {std::string(name_of(outcome.ending)), one_line(outcome.reason), xml::number_text(outcome.time),
        std::to_string(outcome.goals), std::to_string(outcome.failed_goals), std::to_string(outcome.contacts),
        std::string(name_of(outcome.failure)), outcome.trace_hash, outcome.sketch.tracks,
        outcome.sketch.contacts, outcome.sketch.walls})
    text += line + "\n";
  for (const Measure& measure : all_measures()) {
    const std::optional<double>& value = outcome.measures.*measure.value;
    text += (value ? xml::number_text(*value) : std::string(kMissing)) + "\n";
  }
  return text;
}

std::optional<Outcome> read_outcome(std::string_view text) {
  const std::vector<std::string_view> lines = lines_of(text);
  if (lines.size() != kLinesBesideMeasures + all_measures().size()) return std::nullopt;
  const std::optional<Ending> ending = ending_of(lines[0]);
  const std::optional<Failure> failure = failure_of(lines[6]);
  Outcome outcome;
  if (!ending || !failure || !read_number(lines[2], outcome.time) || !read_number(lines[3], outcome.goals) ||
      !read_number(lines[4], outcome.failed_goals) || !read_number(lines[5], outcome.contacts) ||
      !read_measures(std::span(lines).subspan(kLinesBesideMeasures), outcome.measures))
    return std::nullopt;
  outcome.ending = *ending;
  outcome.reason = lines[1];
  outcome.failure = *failure;
  outcome.trace_hash = lines[7];
  outcome.sketch = {std::string(lines[8]), std::string(lines[9]), std::string(lines[10])};
  return outcome;
}

std::string laps_text(const std::vector<LapCost>& laps) {
  std::string text;
  for (const LapCost& one : laps)
    text += (text.empty() ? "" : ";") + one.component + " " + std::to_string(one.laps) + " " +
            xml::number_text(one.mean) + " " + xml::number_text(one.p95) + " " +
            xml::number_text(one.longest);
  return text;
}

std::optional<std::vector<LapCost>> read_laps(std::string_view text) {
  std::vector<LapCost> laps;
  std::istringstream parts{std::string(text)};
  for (std::string part; std::getline(parts, part, ';');) {
    std::istringstream words(part);
    LapCost one;
    std::string mean, p95, longest;
    if (!(words >> one.component >> one.laps >> mean >> p95 >> longest) || !read_number(mean, one.mean) ||
        !read_number(p95, one.p95) || !read_number(longest, one.longest))
      return std::nullopt;
    laps.push_back(std::move(one));
  }
  return laps;
}

}  // namespace orca::batch
