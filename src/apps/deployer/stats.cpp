// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "stats.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "figures.hpp"

namespace orca::deployer {
namespace {

using Row = std::vector<std::string>;

std::vector<std::size_t> widths_of(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size());
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  return widths;
}

// Returns the rows as lines. The first column is flush left, the numbers are flush right.
std::string aligned(const std::vector<Row>& rows) {
  const std::vector<std::size_t> widths = widths_of(rows);
  std::string text;
  for (const Row& row : rows) {
    text += row[0] + std::string(widths[0] - row[0].size(), ' ');
    for (std::size_t i = 1; i < row.size(); ++i)
      text += "  " + std::string(widths[i] - row[i].size(), ' ') + row[i];
    text += "\n";
  }
  return text;
}

std::string edge_table(const host::RunCounters& counters) {
  if (counters.edges.empty()) return {};
  std::vector<Row> rows{{"connection", "delivered", "dropped", "unread", "late", "high water"}};
  for (const auto& [from, to, counted, ages] : counters.edges) {
    const std::uint64_t dropped = counted.dropped - counted.left_behind;
    rows.push_back({from + " -> " + to, std::to_string(counted.delivered), std::to_string(dropped),
                    std::to_string(counted.left_behind), std::to_string(counted.missed_deadlines),
                    std::to_string(counted.high_water)});
  }
  return aligned(rows) + "\n";
}

std::string client_table(const host::RunCounters& counters) {
  if (counters.clients.empty()) return {};
  std::vector<Row> rows{{"sends or asks", "sent", "answered", "failed", "timed out"}};
  for (const auto& [port, counted] : counters.clients)
    rows.push_back({port, std::to_string(counted.sent), std::to_string(counted.answered),
                    std::to_string(counted.failed), std::to_string(counted.timed_out)});
  return aligned(rows) + "\n";
}

std::string computing_table(const host::RunCounters& counters) {
  if (counters.computing.empty()) return {};
  std::vector<Row> rows{{"computes", "laps", "time [s]", "waited [s]", "overruns"}};
  for (const auto& [component, counted] : counters.computing)
    rows.push_back({component, std::to_string(counted.laps), fixed(to_seconds(counted.time), 3),
                    fixed(to_seconds(counted.waited), 3), std::to_string(counted.overruns)});
  return aligned(rows) + "\n";
}

// Objects that an edge drops although it may are mentioned only where there are any.
std::string drops_of(const host::RunCounters& counters) {
  std::uint64_t accepted = 0;
  std::uint64_t over = 0;
  for (const auto& edge : counters.edges) {
    over += edge.counters.over_limit;
    accepted += edge.counters.dropped - edge.counters.left_behind - edge.counters.over_limit;
  }
  return count_of(over, "drop") + (accepted + over > 0 ? " beyond a limit" : "");
}

}  // namespace

std::string trouble_text(const host::RunCounters& counters) {
  std::uint64_t late = 0;
  std::uint64_t refused = 0;
  for (const auto& edge : counters.edges) late += edge.counters.missed_deadlines;
  for (const auto& [port, counted] : counters.clients) refused += counted.failed + counted.timed_out;
  return drops_of(counters) + ", " + count_of(late, "missed deadline") + ", " + count_of(refused, "refusal") +
         "\n";
}

std::string stats_text(const host::RunCounters& counters) {
  return edge_table(counters) + client_table(counters) + computing_table(counters) + trouble_text(counters);
}

}  // namespace orca::deployer
