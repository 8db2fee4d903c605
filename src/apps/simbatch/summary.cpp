// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "summary.hpp"

#include <array>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <map>
#include <utility>

#include "orca/batch/statistics/bootstrap.hpp"
#include "orca/batch/statistics/holm.hpp"
#include "orca/batch/statistics/mcnemar.hpp"
#include "orca/batch/statistics/verdict.hpp"

namespace orca::simbatch {
namespace {

using Place = std::pair<std::string, std::uint64_t>;  // world and seed
using Successes = std::map<Place, bool>;

std::string percent(double share) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f", 100.0 * share);
  return text.data();
}

std::string span_text(const batch::Interval& interval) {
  return percent(interval.low) + " to " + percent(interval.high) + " %";
}

// Returns 1 for a success and 0 for anything else, by world, at the places that both have.
std::vector<std::vector<double>> by_world(const Successes& some, const Successes& others) {
  std::map<std::string, std::vector<double>> worlds;
  for (const auto& [place, success] : some)
    if (others.contains(place)) worlds[place.first].push_back(success ? 1.0 : 0.0);
  std::vector<std::vector<double>> values;
  for (auto& [world, of_world] : worlds) values.push_back(std::move(of_world));
  return values;
}

std::string line_of(const std::string& variant, const Successes& successes,
                    const std::map<batch::Ending, std::size_t>& endings) {
  const auto estimate = batch::bootstrap_mean(by_world(successes, successes));
  std::string text = variant + ": " + std::to_string(successes.size()) + " runs, ";
  if (estimate)
    text += percent(estimate->value) + " % succeed (95 %: " + span_text(estimate->interval) +
            " over worlds and seeds)";
  for (const auto& [ending, count] : endings)
    if (ending != batch::Ending::success) text += ", " + std::to_string(count) + " " + batch::name_of(ending);
  return text + "\n";
}

// Two variants, and the runs that only one of them survives.
struct Pair {
  std::string first, second;
  std::uint64_t only_first = 0, only_second = 0;
  std::uint64_t both = 0;  // runs of each
};

Pair pair_of(const std::string& first, const Successes& its, const std::string& second,
             const Successes& others) {
  Pair pair{first, second};
  for (const auto& [place, success] : its) {
    const auto other = others.find(place);
    if (other == others.end()) continue;
    ++pair.both;
    if (success && !other->second) ++pair.only_first;
    if (!success && other->second) ++pair.only_second;
  }
  return pair;
}

std::string line_of(const Pair& pair, double adjusted_p, const std::map<std::string, Successes>& successes) {
  const Successes& first = successes.at(pair.first);
  const Successes& second = successes.at(pair.second);
  const auto difference = batch::bootstrap_difference(by_world(first, second), by_world(second, first));
  if (!difference) return "";
  const auto verdict = batch::judge({pair.both, pair.both, adjusted_p, difference->interval});
  if (!verdict) return "";
  return pair.first + " - " + pair.second + ", success: " + percent(difference->value) +
         " % (95 %: " + span_text(difference->interval) + "), " + verdict->text + "\n";
}

std::vector<Pair> pairs_of(const std::map<std::string, Successes>& successes) {
  std::vector<Pair> pairs;
  for (auto first = successes.begin(); first != successes.end(); ++first)
    for (auto second = std::next(first); second != successes.end(); ++second)
      pairs.push_back(pair_of(first->first, first->second, second->first, second->second));
  return pairs;
}

}  // namespace

std::string summary_text(const std::vector<batch::Row>& rows) {
  std::map<std::string, Successes> successes;
  std::map<std::string, std::map<batch::Ending, std::size_t>> endings;
  for (const batch::Row& row : rows) {
    successes[row.variant][{row.world, row.seed}] = row.outcome.ending == batch::Ending::success;
    ++endings[row.variant][row.outcome.ending];
  }
  std::string text;
  for (const auto& [variant, its] : successes) text += line_of(variant, its, endings[variant]);
  const std::vector<Pair> pairs = pairs_of(successes);
  std::vector<double> p_values;
  for (const Pair& pair : pairs) p_values.push_back(batch::mcnemar(pair.only_first, pair.only_second).p);
  if (pairs.empty()) return text;
  const auto adjusted = batch::holm(p_values);
  for (std::size_t i = 0; adjusted && i < pairs.size(); ++i)
    text += line_of(pairs[i], (*adjusted)[i], successes);
  return text;
}

}  // namespace orca::simbatch
