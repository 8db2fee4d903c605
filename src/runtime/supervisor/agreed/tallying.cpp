// SPDX-License-Identifier: LGPL-3.0-or-later
#include "tallying.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace orca::supervisor {
namespace {

constexpr double kMillimetres = 1000.0;  // per metre

using Numbers = std::vector<std::uint64_t>;

std::uint64_t to_millimetres(double metres) {
  return static_cast<std::uint64_t>(std::llround(metres * kMillimetres));
}
double to_metres(std::uint64_t millimetres) { return static_cast<double>(millimetres) / kMillimetres; }

// All counters of a type, in the order in which they travel.
template <class Counters>
struct Listed {
  std::vector<std::uint64_t Counters::*> wide;
  std::vector<std::uint32_t Counters::*> narrow;
};

Listed<EdgeCounters> fields_of(const EdgeCounters& /*counters*/) {
  using C = EdgeCounters;
  return {
      {&C::delivered, &C::dropped, &C::dropped_oldest, &C::dropped_newest, &C::dropped_blocked,
       &C::dropped_by_link, &C::unmatched, &C::left_behind, &C::over_limit, &C::waits, &C::missed_deadlines},
      {&C::queued, &C::high_water}};
}

Listed<IntakeCounters> fields_of(const IntakeCounters& /*counters*/) {
  using C = IntakeCounters;
  return {
      {&C::accepted, &C::refused, &C::failed, &C::refused_full, &C::refused_closed, &C::withdrawn, &C::waits},
      {&C::queued, &C::high_water}};
}

Listed<RequestCounters> fields_of(const RequestCounters& /*counters*/) {
  using C = RequestCounters;
  return {{&C::sent, &C::answered, &C::failed, &C::timed_out}, {}};
}

template <class Counters>
Numbers numbers_of(const Counters& counters) {
  Numbers numbers;
  const auto fields = fields_of(counters);
  for (const auto field : fields.wide) numbers.push_back(counters.*field);
  for (const auto field : fields.narrow) numbers.push_back(counters.*field);
  return numbers;
}

template <class Counters>
Counters counters_from(const Numbers& numbers) {
  Counters counters;
  const auto fields = fields_of(counters);
  const auto at = [&](std::size_t index) { return index < numbers.size() ? numbers[index] : 0; };
  std::size_t next = 0;
  for (const auto field : fields.wide) counters.*field = at(next++);
  for (const auto field : fields.narrow) counters.*field = static_cast<std::uint32_t>(at(next++));
  return counters;
}

template <class Counters>
std::vector<Counts> counts_of(const std::map<std::string, Counters>& by_name) {
  std::vector<Counts> all;
  for (const auto& [name, counters] : by_name) all.push_back({name, numbers_of(counters)});
  return all;
}

template <class Counters>
void merge(const std::vector<Counts>& all, std::map<std::string, Counters>& by_name) {
  for (const Counts& counts : all) by_name[counts.name] = counters_from<Counters>(counts.numbers);
}

// Adds the counters of a later life to those of earlier ones.
template <class Counters>
void add_counts(const std::vector<Counts>& more, std::vector<Counts>& sum) {
  if (sum.empty()) return void(sum = more);
  const std::size_t wide = fields_of(Counters{}).wide.size();
  for (const Counts& counts : more) {
    const auto known = std::ranges::find(sum, counts.name, &Counts::name);
    if (known == sum.end()) {
      sum.push_back(counts);
      continue;
    }
    for (std::size_t i = 0; i < std::min(known->numbers.size(), counts.numbers.size()); ++i) {
      std::uint64_t& number = known->numbers[i];
      number = i < wide ? number + counts.numbers[i] : std::max(number, counts.numbers[i]);
    }
  }
}

std::string name_of(const std::string& from, const std::string& to) { return from + " to " + to; }

std::uint64_t first_of(const Counts& counts) { return counts.numbers.empty() ? 0 : counts.numbers.front(); }

}  // namespace

Tally to_tally(const host::RunCounters& counters, const std::vector<host::RunResult::Way>& ways) {
  Tally tally;
  for (const auto& edge : counters.edges)
    tally.edges.push_back({name_of(edge.from, edge.to), numbers_of(edge.counters)});
  tally.clients = counts_of(counters.clients);
  tally.servers = counts_of(counters.servers);
  for (const auto& way : ways) tally.ways.push_back({way.robot, {to_millimetres(way.length)}});
  return tally;
}

void add(const Tally& more, Tally& sum) {
  add_counts<EdgeCounters>(more.edges, sum.edges);
  add_counts<RequestCounters>(more.clients, sum.clients);
  add_counts<IntakeCounters>(more.servers, sum.servers);
  if (sum.ways.empty()) return void(sum.ways = more.ways);
  for (Counts& way : sum.ways)
    for (const Counts& other : more.ways)
      if (other.name == way.name) way.numbers = {first_of(way) + first_of(other)};
}

host::RunCounters counters_of(const graph::Graph& graph, const std::map<std::string, Tally>& tallies) {
  host::RunCounters counters;
  std::map<std::string, EdgeCounters> edges;
  for (const auto& [process, tally] : tallies) {
    merge(tally.edges, edges);
    merge(tally.clients, counters.clients);
    merge(tally.servers, counters.servers);
  }
  for (const graph::Edge& edge : graph.edges)
    if (const auto counted = edges.find(name_of(edge.from.text(), edge.to.text())); counted != edges.end())
      counters.edges.push_back({edge.from.text(), edge.to.text(), counted->second});
  return counters;
}

std::vector<host::RunResult::Way> ways_of(const std::map<std::string, Tally>& tallies) {
  std::map<std::string, std::uint64_t> longest;
  for (const auto& [process, tally] : tallies)
    for (const Counts& way : tally.ways) longest[way.name] = std::max(longest[way.name], first_of(way));
  std::vector<host::RunResult::Way> ways;
  for (const auto& [robot, length] : longest) ways.push_back({robot, to_metres(length)});
  return ways;
}

Glance to_report(const host::RunGlance& glance) {
  Glance shown;
  for (const auto& [name, state] : glance.unwell) shown.unwell.emplace_back(name, state);
  for (const auto& [name, distance] : glance.goals) shown.goals.push_back({name, {to_millimetres(distance)}});
  return shown;
}

void add(const Glance& shown, host::RunGlance& glance) {
  for (const auto& [name, state] : shown.unwell) glance.unwell.push_back({name, state});
  for (const Counts& goal : shown.goals) glance.goals.push_back({goal.name, to_metres(first_of(goal))});
}

}  // namespace orca::supervisor
