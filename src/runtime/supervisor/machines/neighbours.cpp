// SPDX-License-Identifier: LGPL-3.0-or-later
#include "machines/neighbours.hpp"

#include <utility>

#include "orca/base/files/key_folder.hpp"
#include "orca/base/log.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/base/text.hpp"
#include "orca/idl/machines.hpp"
#include "orca/supervisor/log_name.hpp"

namespace orca::supervisor {
namespace {

using host::RunOutcome;

constexpr auto kRepeat = 200ms;
constexpr auto kRepeatEnd = 50ms;
constexpr auto kLeaveLimit = 1s;
constexpr auto kListen = 700ms;

Meet meet(const graph::Graph& graph, const std::string& here) {
  Meet meet;
  meet.name = "peers";
  meet.type = "orca::idl::MachineState";
  meet.topic = "orca/" + graph.name + "/machines";
  meet.domain = graph.domain;
  for (const graph::MachineNode& node : graph.machines) {
    if (node.name == here) {
      meet.address = node.address;
      meet.interface = node.interface;
    } else if (!node.address.empty()) {
      meet.others.push_back(node.address);
    }
  }
  // Without a home there is no such folder, and the process says so.
  if (graph.secured) meet.keys = key_folder(graph.name, here).value_or("/orca/keys");
  return meet;
}

// The number of a run: by the clock, so that a later one is larger.
std::uint64_t new_run() { return static_cast<std::uint64_t>(steady_now().time_since_epoch().count()); }

std::string state_text(const Gathering::Standing& standing) {
  if (!standing.phase) return "not heard yet";
  if (standing.lost) return "lost";
  switch (*standing.phase) {
    case idl::MACHINE_GATHERING: return "waits for others";
    case idl::MACHINE_WORKING: return "works";
    case idl::MACHINE_ENDED: return "has ended";
    default: return "comes up";
  }
}

// Returns a number of a table; nothing: it is not known.
Cell number(const std::string& name, const std::optional<Duration>& time, double factor, int digits) {
  if (time) return {name, factor * to_seconds(*time), digits};
  Cell unknown(name, "");
  unknown.kind = Cell::Kind::number;
  return unknown;
}

// Returns the line of a machine for people. All have the same cells.
Record line_of(const std::string& machine, const std::string& state, const std::optional<Duration>& silence,
               const std::optional<Clocks::Offset>& clock, bool is_corrected) {
  constexpr double kMs = 1e3;
  const auto time = [&clock](Duration Clocks::Offset::*part) {
    return clock ? std::optional((*clock).*part) : std::nullopt;
  };
  return {{"machine", machine},
          {"state", state},
          number("heard_s", silence, 1.0, 1),
          number("clock_ahead_ms", time(&Clocks::Offset::ahead), kMs, 3),
          number("error_ms", time(&Clocks::Offset::error), kMs, 3),
          number("round_trip_ms", time(&Clocks::Offset::round_trip), kMs, 3),
          {"corrected", is_corrected}};
}

idl::MachineEnd end_of(RunOutcome outcome) {
  switch (outcome) {
    case RunOutcome::finished: return idl::MACHINE_FINISHED;
    case RunOutcome::time_is_up: return idl::MACHINE_TIME_IS_UP;
    case RunOutcome::stopped: return idl::MACHINE_STOPPED;
    case RunOutcome::not_started: return idl::MACHINE_NOT_STARTED;
    default: return idl::MACHINE_FAILED;
  }
}

}  // namespace

RunOutcome outcome_of(idl::MachineEnd end) {
  switch (end) {
    case idl::MACHINE_FINISHED: return RunOutcome::finished;
    case idl::MACHINE_TIME_IS_UP: return RunOutcome::time_is_up;
    case idl::MACHINE_STOPPED: return RunOutcome::stopped;
    case idl::MACHINE_NOT_STARTED: return RunOutcome::not_started;
    default: return RunOutcome::failed;
  }
}

Neighbours::Neighbours(const graph::Graph& graph, const std::string& here, HostStart start, Ledger& ledger,
                       const RunPage& page)
    : here_(here),
      run_(new_run()),
      gathering_(graph, here, run_),
      clocks_(here, run_),
      motors_(here, gathering_.missing()),
      messenger_(std::move(start), "the other machines", meet(graph, here),
                 [this](std::span<const std::byte> bytes) {
                   idl::MachineState state;
                   if (object_type<idl::MachineState>().deserialize(bytes, &state).ok()) hear(state);
                 }),
      ledger_(ledger),
      page_(page) {
  for (const graph::MachineNode& node : graph.machines) places_.emplace(node.name, places_.size());
}

void Neighbours::hear(const idl::MachineState& state) {
  const TimePoint now = steady_now();
  if (!gathering_.hear(state, to_steady(now))) return;
  motors_.hear(state, !has_gathered_);
  clocks_.hear(state, now);
  tell_clocks(now);
}

// Reports clocks that differ, and lets the host processes correct what comes from there. Until a clock is measured, those that an
// earlier supervisor has left go on as it told them.
void Neighbours::tell_clocks(TimePoint now) {
  for (const Clocks::News& news : clocks_.take_news()) {
    if (news.differs)
      ledger_.raise(idl::CLOCKS_DIFFER, "", news.text, news.machine);
    else
      ledger_.settle(idl::CLOCKS_DIFFER, news.machine, news.text);
  }
  for (const auto& [machine, place] : places_)
    if (place < RunPage::kMostMachines && clocks_.offset(machine, now))
      page_.clock_ahead(place).store(clocks_.correction(machine).count(), std::memory_order_relaxed);
}

void Neighbours::turn(Moment now) {
  messenger_.turn(now);
  gathering_.look(now);
  tell_news();
  publish(now);
}

void Neighbours::tell_news() {
  for (const Gathering::News& news : gathering_.take_news()) {
    using NewsKind = Gathering::News::Kind;
    if (news.kind == NewsKind::lost) {
      ledger_.raise(idl::MACHINE_LOST, "", news.text, news.machine);
      continue;
    }
    log::write(news.kind == NewsKind::warning ? log::Level::warning : log::Level::info, kLogName, news.text);
    if (news.kind == NewsKind::back) ledger_.settle(idl::MACHINE_LOST, news.machine, news.text);
  }
}

// A new run listens first: if another deployer runs for this machine, its neighbours never hear of this one.
bool Neighbours::listens(Moment now) const {
  const std::optional<Moment> since = messenger_.speaks_since();
  return gathering_.state().phase() == idl::MACHINE_GATHERING && (!since || now < *since + kListen);
}

void Neighbours::publish(Moment now) {
  idl::MachineState state = gathering_.state();
  motors_.fill(state);
  if (listens(now) || (state == said_ && now < say_at_)) return;
  said_ = state;
  say_at_ = now + (state.phase() == idl::MACHINE_ENDED ? kRepeatEnd : kRepeat);
  state.seq(++seq_);
  clocks_.fill(state, steady_now());
  messenger_.say(state, now);
}

bool Neighbours::have_gathered() {
  if (has_gathered_) return true;
  const std::string awaited = this->awaited();
  has_gathered_ = awaited.empty();
  if (has_gathered_) {
    gathering_.enter(idl::MACHINE_BUILDING);
  } else if (std::exchange(told_, awaited) != awaited) {
    log::info(kLogName, "waiting for " + awaited);
  }
  return has_gathered_;
}

std::string Neighbours::awaited() const {
  const std::vector<std::string> missing = gathering_.missing();
  if (missing.empty()) return "";
  return (missing.size() == 1 ? "machine " : "machines ") + listed(missing);
}

void Neighbours::show(Reply& reply) const {
  const TimePoint now = steady_now();
  reply.add(line_of(here_, "this machine", std::nullopt, Clocks::Offset{}, false));
  for (const Gathering::Standing& standing : gathering_.standings()) {
    std::optional<Duration> silence;
    if (standing.phase) silence = to_steady(now) - standing.heard_at;
    reply.add(line_of(standing.machine, state_text(standing), silence, clocks_.offset(standing.machine, now),
                      clocks_.correction(standing.machine) != Duration{0}));
  }
}

void Neighbours::conclude(RunOutcome outcome, const std::string& why, Moment now) {
  gathering_.end(end_of(outcome), why);
  concluded_at_ = now;
  publish(now);
}

bool Neighbours::take_leave(Moment now) {
  leaves_ = leaves_ || gathering_.have_all_ended() || now > concluded_at_ + kLeaveLimit;
  if (leaves_) messenger_.end(now);
  return leaves_ && messenger_.member().process() == nullptr;
}

}  // namespace orca::supervisor
