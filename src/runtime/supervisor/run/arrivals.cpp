// SPDX-License-Identifier: LGPL-3.0-or-later
#include "arrivals.hpp"

#include <utility>

#include "members/alarm_relay.hpp"
#include "orca/base/log.hpp"
#include "orca/base/steady_clock.hpp"
#include "starting/adoption.hpp"

namespace orca::supervisor {

using Phase = Member::Phase;

void Arrivals::start(const Members& members) {
  const bool is_first = !std::exchange(has_begun_, true);
  for (const Member* const member : members)
    if (member->phase() == Phase::asleep)
      log::info(place_.log_name, "process " + member->name() + " is started, because it is needed");
  for (const Member* const member : members)
    if (!member->node().on_demand) place_.control.lose(*member);  // it gets a graph that may just change
  Starter::Begun begun = place_.starter.start(members);
  bring_up(begun, is_first);
  for (const auto& [member, error] : begun.failed) {
    if (!is_first) {
      place_.could_not_start(*member, error);
    } else if (!place_.conclusion.is_over()) {
      log::error(place_.log_name, error.text());
      place_.conclusion.fail_with(error);
    }
  }
}

void Arrivals::bring_up(Starter::Begun& begun, bool is_first) {
  const Members& members = begun.members;
  if (members.empty()) return;
  watch(members);
  began_.push_back(std::make_unique<BringUp>(
      place_.starter.plan(members), consent(is_first), [this, members] { built(members); },
      [this, members, is_first](const Status& outcome, Member* culprit) {
        outcome.ok() ? came_up(members, is_first) : did_not_come_up(outcome.error(), *culprit);
      }));
  began_.back()->begin(std::move(begun.setups));
}

void Arrivals::watch(const Members& members) {
  for (const Member* member : members) {
    for (const std::string& warning : member->process()->warnings()) log::warning(member->name(), warning);
    place_.beats.watch(member->place(), member->node().hang_limit);
  }
}

// Only the start is common to all machines.
BringUp::Consent Arrivals::consent(bool is_first) const {
  if (!place_.neighbours || !is_first) return {};
  Gathering& gathering = place_.neighbours->gathering();
  return {[&gathering](const std::string& component) { return gathering.may_configure(component); },
          [&gathering] { return gathering.may_begin(); }};
}

void Arrivals::take_over() {
  has_begun_ = true;
  up_since_ = steady_now();
  place_.conclusion.came_up();
}

void Arrivals::go_on() {
  std::erase_if(began_, [](const auto& bring_up) { return bring_up->is_over(); });
  if (place_.conclusion.is_over()) return;
  for (const auto& bring_up : began_) bring_up->go_on();
}

void Arrivals::lose(Member& member) {
  for (const auto& bring_up : began_) bring_up->lose(member);
}

void Arrivals::built(const Members& members) {
  place_.control.built(members);
  place_.trading.brief(members);
  place_.ledger.introduce();
}

void Arrivals::came_up(const Members& members, bool is_first) {
  for (Member* const member : members) {
    if (member->phase() != Phase::up) continue;
    if (!is_first)
      log::info(place_.log_name,
                "process " + member->name() +
                    (member->node().on_demand || (member->starts().is_newcomer && member->restarts() == 0)
                         ? " is up"
                         : " is back"));
    AlarmRelay::brief(*member, place_.ledger.alarms(), is_first);
    let_outlive(*member, place_.rules);
  }
  if (is_first) up_since_ = steady_now();
  if (is_first) place_.conclusion.came_up();
  place_.control.came_up(members);
  if (is_first && place_.neighbours) place_.neighbours->gathering().enter(idl::MACHINE_WORKING);
}

void Arrivals::did_not_come_up(const Error& error, Member& culprit) {
  if (place_.conclusion.is_over()) return;
  if (!place_.conclusion.has_come_up()) return place_.conclusion.refuse_start(error);
  log::error(culprit.name(), "the process does not come up again: " + error.text());
  culprit.heard_last_words(error.text(), Moment::clock::now());
  culprit.process()->end_by_force(Force::refused, Moment::clock::now());
}

}  // namespace orca::supervisor
