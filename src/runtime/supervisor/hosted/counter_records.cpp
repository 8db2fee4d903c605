// SPDX-License-Identifier: LGPL-3.0-or-later
#include "counter_records.hpp"

namespace orca::supervisor {

namespace {

// Returns a cell of milliseconds, empty if nothing was measured lately.
Cell milliseconds(const char* name, const std::optional<TimeFigures>& figures, double TimeFigures::*which) {
  constexpr double kMilli = 1e3;
  if (figures && figures->count > 0) return {name, kMilli * ((*figures).*which), 3};
  Cell none{name, ""};
  none.kind = Cell::Kind::number;
  return none;
}

}  // namespace

std::vector<Record> to_records(const host::RunCounters& counters) {
  std::vector<Record> records;
  for (const auto& [from, to, counted, ages] : counters.edges)
    records.push_back({{"from", from},
                       {"to", to},
                       {"delivered", counted.delivered},
                       {"dropped", counted.dropped - counted.left_behind},
                       {"unread", counted.left_behind},
                       {"late", counted.missed_deadlines},
                       {"queued", counted.queued},
                       {"high_water", counted.high_water},
                       milliseconds("age_p50_ms", ages, &TimeFigures::p50),
                       milliseconds("age_p99_ms", ages, &TimeFigures::p99)});
  for (const auto& [port, counted] : counters.clients)
    records.push_back({{"client", port},
                       {"sent", counted.sent},
                       {"answered", counted.answered},
                       {"failed", counted.failed},
                       {"timed_out", counted.timed_out}});
  for (const auto& [port, counted] : counters.servers)
    records.push_back({{"server", port},
                       {"accepted", counted.accepted},
                       {"refused", counted.refused},
                       {"failed", counted.failed},
                       {"queued", counted.queued},
                       {"high_water", counted.high_water}});
  for (const auto& [component, laps] : counters.laps)
    records.push_back({{"component", component},
                       {"laps", laps.count},
                       milliseconds("lap_p50_ms", laps, &TimeFigures::p50),
                       milliseconds("lap_p99_ms", laps, &TimeFigures::p99)});
  return records;
}

Record to_record(const host::SwapReport& swap) {
  return {{"was", swap.old_type},
          {"type", swap.new_type},
          {"build_id", swap.build_id},
          {"pause_us", static_cast<std::uint64_t>(swap.pause / 1us)},
          {"state", swap.state.empty() ? "begun afresh" : swap.state}};
}

}  // namespace orca::supervisor
