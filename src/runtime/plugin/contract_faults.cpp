// SPDX-License-Identifier: LGPL-3.0-or-later
#include "contract_faults.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <optional>
#include <set>
#include <string_view>

#include "orca/base/text.hpp"

namespace orca::plugin {
namespace {

using Faults = std::vector<std::string>;

// SI's base and derived units that robots meet. Others ("mm", "deg") are for graphs, which convert them.
constexpr std::array<std::string_view, 18> kUnits{"1", "m", "s",  "kg", "g", "rad", "A", "V",   "W",
                                                  "J", "N", "Hz", "K",  "C", "Pa",  "F", "ohm", "%"};

constexpr std::size_t kMostOfName = 200;                            // characters, as in a graph
constexpr Duration kShortestPeriod = std::chrono::microseconds(1);  // the same

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

bool is_name(std::string_view name) {
  return !name.empty() && name.size() <= kMostOfName && is_letter(name.front()) &&
         std::ranges::all_of(name, [](char c) { return is_letter(c) || is_digit(c) || c == '_'; });
}

// Returns whether it is a unit with an exponent, "m", "s2".
bool is_power(std::string_view unit) {
  if (unit.size() > 1 && is_digit(unit.back())) unit.remove_suffix(1);
  return std::ranges::find(kUnits, unit) != kUnits.end();
}

// Returns whether it is a product or quotient of units: "m", "1/s", "m/s2", "N m".
bool is_unit(std::string_view unit) {
  if (unit.empty()) return true;
  while (true) {
    const std::size_t end = unit.find_first_of("/ ");
    if (!is_power(unit.substr(0, end))) return false;
    if (end == std::string_view::npos) return true;
    unit.remove_prefix(end + 1);
  }
}

std::optional<double> number_of(const ParamValue& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
  if (const auto* real = std::get_if<double>(&value)) return *real;
  return std::nullopt;
}

void check_names(const char* what, const std::vector<std::string>& names, Faults& faults) {
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (!is_name(name))
      faults.push_back(std::string(what) + " is called " + in_quotes(name) +
                       "; a name is a letter, then letters, digits and '_', at most " +
                       std::to_string(kMostOfName));
    if (!seen.insert(name).second)
      faults.push_back(std::string("it has two ") + what + "s of the name " + in_quotes(name) +
                       "; give one of them another name");
  }
}

void check_range(const ParamContract& param, Faults& faults) {
  if (param.min && param.max && *param.min > *param.max)
    faults.push_back("the parameter " + in_quotes(param.name) + " has a min above its max; exchange them");
  const std::optional<double> number = number_of(param.default_value);
  if (!number) return;
  const bool in_range = (!param.min || *number >= *param.min) && (!param.max || *number <= *param.max);
  if (!in_range || std::isnan(*number))
    faults.push_back("the default of the parameter " + in_quotes(param.name) +
                     " is outside of its own range; change min, max or the default");
}

void check_choices(const ParamContract& param, Faults& faults) {
  const auto* text = std::get_if<std::string>(&param.default_value);
  if (text == nullptr || param.choices.empty()) return;
  if (std::ranges::find(param.choices, *text) == param.choices.end())
    faults.push_back("the default " + in_quotes(*text) + " of the parameter " + in_quotes(param.name) +
                     " is none of its choices: " + listed(param.choices));
}

void check_unit(const ParamContract& param, Faults& faults) {
  if (!is_unit(param.unit))
    faults.push_back("the parameter " + in_quotes(param.name) + " has the unit " + in_quotes(param.unit) +
                     ", which is none of SI; write for example m, rad, s, m/s, rad/s2, 1/s, or nothing");
}

// Checks what starts the laps, and the buffers of the ports.
void check_times(const Contract& contract, Faults& faults) {
  const Trigger& trigger = contract.default_trigger;
  if (trigger.kind == Trigger::Kind::period && trigger.period < kShortestPeriod)
    faults.push_back("its laps start every " + seconds_text(trigger.period) + "; a period is 1 us or longer");
  if ((trigger.kind != Trigger::Kind::period && trigger.period < Duration{0}) || trigger.within < Duration{0})
    faults.push_back("a time of what starts its laps is negative; 0 s means none");
  for (const PortContract& port : contract.ports) {
    const QueuePolicy& queue = port.queue;
    if (queue.depth == 0)
      faults.push_back("the port " + in_quotes(port.name) + " has a queue of 0 objects; 1 is the shortest");
    if (std::min({queue.min_interval, queue.deadline, queue.block_limit, port.period}) < Duration{0})
      faults.push_back("a time of the port " + in_quotes(port.name) + " is negative; 0 s means none");
  }
}

}  // namespace

Faults faults_of(const Contract& contract) {
  Faults faults;
  Faults ports;
  Faults params;
  for (const PortContract& port : contract.ports) ports.push_back(port.name);
  for (const ParamContract& param : contract.params) params.push_back(param.name);
  check_names("port", ports, faults);
  check_names("parameter", params, faults);
  check_times(contract, faults);
  for (const ParamContract& param : contract.params) {
    check_unit(param, faults);
    check_range(param, faults);
    check_choices(param, faults);
  }
  return faults;
}

}  // namespace orca::plugin
