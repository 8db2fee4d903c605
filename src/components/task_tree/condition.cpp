// SPDX-License-Identifier: LGPL-3.0-or-later
#include "condition.hpp"

#include <algorithm>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/xml/attributes.hpp"
#include "orca/xml/matching.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"

namespace orca::tasks {
namespace {

constexpr const char* kForms =
    R"(; write "alarm BATTERY_LOW", "alarm BATTERY_LOW of base", or a port, its field and what it is to be: )"
    R"("battery.charge below 0.3", "gripper.holds is true"; with "not " before it the opposite)";

Error bad(const std::string& why) { return fail(Code::invalid_argument, why + kForms); }

using Words = std::vector<std::string_view>;

bool is_kind(std::string_view word) {
  return !word.empty() && std::ranges::all_of(word, [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

Result<Condition> parse_alarm(const Words& words, Condition condition) {
  const bool has_source = words.size() == 4 && words[2] == "of";
  if (words.size() != 2 && !has_source) return bad("this is no alarm");
  if (!is_kind(words[1])) return bad("the kind of an alarm is a word of capitals");
  condition.subject = words[1];
  if (has_source) condition.detail = words[3];
  return condition;
}

std::vector<std::string> ports_of(std::span<const Sight> sights) {
  std::vector<std::string> ports;
  for (const Sight& sight : sights) ports.push_back(sight.port);
  return ports;
}

// Takes "battery.charge" apart.
Status set_field(std::string_view word, std::span<const Sight> sights, Condition& condition) {
  const std::size_t dot = word.find('.');
  condition.subject = word.substr(0, dot);
  const auto sight = std::ranges::find(sights, condition.subject, &Sight::port);
  const std::vector<std::string> ports = ports_of(sights);
  if (sight == sights.end())
    return bad("there is no port " + in_quotes(condition.subject) + " to look at, only " + listed(ports) +
               xml::did_you_mean(xml::nearest_name(condition.subject, ports)));
  condition.detail = dot == std::string_view::npos ? "" : word.substr(dot + 1);
  const std::string list = condition.detail.substr(0, condition.detail.find('['));
  if (std::ranges::find(sight->fields, list) == sight->fields.end())
    return bad("what comes at " + in_quotes(condition.subject) + " has no field " +
               in_quotes(condition.detail) + ", but " + listed(sight->fields) +
               xml::did_you_mean(xml::nearest_name(list, sight->fields)));
  return ok();
}

// Returns the words that the field of a condition can be; none: anything.
std::vector<std::string> words_of(const Condition& condition, std::span<const Sight> sights) {
  const auto sight = std::ranges::find(sights, condition.subject, &Sight::port);
  const auto found = sight->words.find(condition.detail);
  return found == sight->words.end() ? std::vector<std::string>{} : found->second;
}

Result<Condition> parse_field(const Words& words, std::span<const Sight> sights, Condition condition) {
  if (words.size() != 3) return bad("this is no condition");
  if (Status set = set_field(words[0], sights, condition); !set.ok()) return set.error();
  const std::vector<std::string> choices = words_of(condition, sights);
  if (words[1] == "is") {
    condition.relation = Condition::Relation::is;
    condition.value = words[2];
    if (!choices.empty() && std::ranges::find(choices, words[2]) == choices.end())
      return bad(in_quotes(words[0]) + " is never " + in_quotes(words[2]) + "; it is one of: " +
                 listed(choices) + xml::did_you_mean(xml::nearest_name(words[2], choices)));
    return condition;
  }
  if (words[1] != "below" && words[1] != "above") return bad(in_quotes(words[1]) + " compares nothing");
  if (!choices.empty()) return bad(in_quotes(words[0]) + " is no number; it is one of: " + listed(choices));
  const Result<double> limit = xml::parse_number(words[2]);
  if (!limit) return bad(limit.error().message);
  condition.relation = words[1] == "below" ? Condition::Relation::below : Condition::Relation::above;
  condition.limit = *limit;
  return condition;
}

// Returns whether the last value of a field is as it should be; nothing if that cannot be said.
std::optional<bool> compare(const Condition& condition, const std::string& found) {
  if (condition.relation == Condition::Relation::is) return found == condition.value;
  const Result<double> number = xml::parse_number(found);
  if (!number) return std::nullopt;
  return condition.relation == Condition::Relation::below ? *number < condition.limit
                                                          : *number > condition.limit;
}

std::optional<bool> judge(const Condition& condition, const Outlook& outlook) {
  if (condition.relation == Condition::Relation::alarm)
    return outlook.alarm(condition.subject, condition.detail);
  const std::optional<std::string> found = outlook.field(condition.subject, condition.detail);
  return found ? compare(condition, *found) : std::nullopt;
}

}  // namespace

Result<Condition> parse_condition(std::string_view text, std::span<const Sight> sights) {
  Condition condition;
  condition.text = std::string(xml::trimmed(text));
  Words words = xml::words(text);
  condition.negated = !words.empty() && words.front() == "not";
  if (condition.negated) words.erase(words.begin());
  if (words.empty()) return bad("there is no condition");
  if (words.front() == "alarm") return parse_alarm(words, std::move(condition));
  return parse_field(words, sights, std::move(condition));
}

bool holds(const Condition& condition, const Outlook& outlook) {
  const std::optional<bool> is = judge(condition, outlook);
  return is && *is != condition.negated;
}

}  // namespace orca::tasks
