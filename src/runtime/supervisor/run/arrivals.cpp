// SPDX-License-Identifier: LGPL-3.0-or-later
#include "arrivals.hpp"

#include <memory>
#include <utility>

#include "members/alarm_relay.hpp"
#include "orca/base/log.hpp"
#include "orca/base/steady_clock.hpp"
#include "starting/adoption.hpp"

namespace orca::supervisor {

using Phase = Member::Phase;

namespace {

constexpr Duration kRecorderLimit = 3s;  // for the lines of all recorders

}  // namespace

void Arrivals::start(const Members& members) {
  const bool is_first = !std::exchange(has_begun_, true);
  for (const Member* const member : members)
    if (member->phase() == Phase::asleep)
      log::info(place_.log_name, "process " + member->name() + " is started, because it is needed");
  for (const Member* const member : members)
    if (!member->node().on_demand) place_.control.lose(*member);  // it gets a graph that may just change
  const auto begun = std::make_shared<Starter::Begun>(place_.starter.start(members));
  watch(begun->members);
  place_.conductor.begin("bring-up", [this, begun, is_first] { bring_up(*begun, is_first); });
  for (const auto& [member, error] : begun->failed) {
    if (!is_first) {
      place_.could_not_start(*member, error);
    } else if (!place_.conclusion.is_over()) {
      place_.conclusion.report_failure(error);
    }
  }
}

void Arrivals::watch(const Members& members) {
  for (const Member* member : members) {
    for (const std::string& warning : member->process()->warnings()) log::warning(member->name(), warning);
    place_.beats.watch(member->place(), member->node().hang_limit);
  }
}

// Each is set up and built, and opens its hardware. Then components are configured one after the other, whichever process
// they are in, and all gates open.
void Arrivals::bring_up(Starter::Begun& begun, bool is_first) {
  const Company company({place_.conductor, [this] { return place_.conclusion.is_over(); },
                         [this](Member& culprit, const Error& error) { did_not_come_up(culprit, error); }},
                        begun.members);
  const StartOrder components = place_.starter.in_start_order(begun.members);
  auto setup = begun.setups.begin();
  if (!company.ask_all([&](const Member&) { return std::move(*setup++); })) return;
  if (!company.ask_all([](const Member&) { return Build{}; })) return;
  built(company.present());
  if (!company.ask_all([](const Member&) { return OpenHardware{}; })) return;
  if (!configure_all(company, components, is_first)) return;
  if (is_first) wait_for_recorders(company);
  for (Member* const member : company.present()) {
    member->tell(OpenGates{});
    member->enter(Phase::up);
  }
  came_up(company.present(), is_first);
}

// A run does not fail for want of a recording; what is missing in it is said when the run is over.
void Arrivals::wait_for_recorders(const Company& company) const {
  const TimePoint limit = steady_now() + kRecorderLimit;
  (void)company.wait(
      [&] { return place_.control.count_recorders() >= place_.recorders || steady_now() >= limit; });
}

// Only the start is common to all machines. Returns false if nothing more will happen.
bool Arrivals::configure_all(const Company& company, const StartOrder& components, bool is_first) {
  const bool is_common = is_first && place_.neighbours;
  for (const auto& [member, component] : components) {
    const auto is_its_turn = [&, &who = *member, &name = component] {
      return !is_common || !company.has(who) || place_.neighbours->gathering().may_configure(name);
    };
    if (!company.wait(is_its_turn)) return false;
    if (company.has(*member) && !company.ask(*member, Configure{component})) return false;
  }
  return company.wait([&] { return !is_common || place_.neighbours->gathering().may_begin(); });
}

void Arrivals::take_over() {
  has_begun_ = true;
  up_since_ = steady_now();
  place_.conclusion.came_up();
}

void Arrivals::built(const Members& members) {
  place_.control.built(members);
  place_.trading.brief(members);
  place_.ledger.introduce();
}

void Arrivals::came_up(const Members& members, bool is_first) {
  for (Member* const member : members) {
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

void Arrivals::did_not_come_up(Member& culprit, const Error& error) {
  if (place_.conclusion.is_over()) return;
  if (!place_.conclusion.has_come_up()) return place_.conclusion.refuse_start(error);
  log::error(culprit.name(), "the process does not come up again: " + error.text());
  culprit.heard_last_words(error.text(), Moment::clock::now());
  culprit.process()->end_by_force(Force::refused, Moment::clock::now());
}

}  // namespace orca::supervisor
