// SPDX-License-Identifier: LGPL-3.0-or-later
#include "on_demand.hpp"

#include <utility>

#include "orca/base/log.hpp"

namespace orca::supervisor {

Members OnDemand::put_others_to_sleep() const {
  Members at_once;
  for (Member* const member : all_) {
    if (member->node().on_demand)
      member->enter(Member::Phase::asleep);
    else
      at_once.push_back(member);
  }
  return at_once;
}

bool OnDemand::is_needed(const Member& member) const {
  const auto state = states_.find(&member);
  const bool is_wanted = state != states_.end() && state->second.is_wanted;
  return is_wanted || starter_.wiring().traffic_to(member.name()) > 0;
}

void OnDemand::look(Moment now) {
  for (Member* const member : all_)
    if (member->node().on_demand) look_at(*member, states_[member], now);
}

void OnDemand::look_at(Member& member, State& state, Moment now) {
  const bool is_up = member.phase() == Member::Phase::up;
  const std::uint64_t traffic = starter_.wiring().traffic_to(member.name());
  const bool is_used = traffic != std::exchange(state.traffic, traffic) || ledger_.is_in_use(member.name());
  if (state.lacks_edges && member.phase() == Member::Phase::asleep) renew_edges(member, state);
  state.is_wanted = state.is_wanted && !is_up;
  state.is_asked = state.is_asked && is_up;
  if (!is_up || is_used || member.node().idle_time == Duration{0}) {
    state.last_use = now;
  } else if (now - state.last_use >= member.node().idle_time && !state.is_asked) {
    ask(member, state, now);
  }
}

// Asks a process whether it is busy with something, such as a question that takes long.
void OnDemand::ask(Member& member, State& state, Moment now) {
  state.is_asked = true;
  member.ask(AskUse{}, [this, &member, &state, now](const Status& unused) {
    state.is_asked = false;
    state.last_use = now;
    if (unused.ok() && member.phase() == Member::Phase::up) end_(member);
  });
}

void OnDemand::fall_asleep(Member& member) {
  member.enter(Member::Phase::asleep);
  renew_edges(member, states_[&member]);
}

void OnDemand::renew_edges(Member& member, State& state) {
  const Status renewed = starter_.renew_edges_of(member);
  if (!renewed.ok() && !state.lacks_edges)
    log::error(member.name(), "nobody can wake the process at present: " + renewed.error().text());
  state.lacks_edges = !renewed.ok();
}

}  // namespace orca::supervisor
