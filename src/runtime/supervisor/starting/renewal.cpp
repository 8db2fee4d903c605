// SPDX-License-Identifier: LGPL-3.0-or-later
#include "renewal.hpp"

#include <algorithm>
#include <utility>

#include "orca/base/log.hpp"

namespace orca::supervisor {

Status Renewal::carry_out(const Wish& wish) {
  wish_ = wish;
  failure_.reset();
  others_.clear();
  finished_.clear();
  for (const Member* const member : members())
    if (place_.policy.has_finished(member->index())) finished_.insert(member->name());
  place_.starter.forget_old_states();
  Status outcome = go_over();
  phase_ = Phase::none;
  if (!place_.is_over()) return outcome;
  return fail(Code::unavailable, "the run ends before all processes have begun anew");
}

Status Renewal::go_over() {
  end_all(Phase::ending);
  if (place_.is_over()) return ok();
  const Starter::States states = place_.starter.states();
  wish_.go();
  begin_all(Phase::beginning);
  const bool is_settled = conductor_.wait([this] { return place_.is_over() || failure_ || is_up(); },
                                          Moment::clock::now() + kStartLimit);
  if (!is_settled) failure_ = fail(Code::deadline_exceeded, "not everything came up in time");
  return failure_ ? Status(go_back(states)) : ok();
}

// The states that count are those of the first end: code that was there for a moment only may have written others.
Error Renewal::go_back(const Starter::States& states) {
  end_all(Phase::ending_again);
  if (place_.is_over()) return *failure_;
  wish_.go_back();
  place_.starter.set_states(states);
  begin_all(Phase::beginning_again);
  conductor_.wait([this] { return place_.is_over() || phase_ == Phase::none || is_up(); },
                  Moment::clock::now() + kStartLimit);
  return *failure_;
}

void Renewal::note_start(const Member& member) {
  if (phase_ == Phase::beginning && !wish_.processes.contains(member.name())) others_.insert(member.name());
}

bool Renewal::lose(const Member& member, bool is_normal, const std::string& how) {
  const bool concerns = wish_.processes.contains(member.name()) || others_.contains(member.name());
  const bool ends = phase_ == Phase::ending || phase_ == Phase::ending_again;
  if (phase_ == Phase::none || !concerns || (!ends && others_.contains(member.name()))) return false;
  if (ends && !is_normal)
    log::warning(place_.log_name, "process " + member.name() + ", which is to begin anew, " + how);
  if (phase_ == Phase::beginning_again) {
    failure_ = fail(failure_->code, failure_->text() + "; and process " + member.name() + " " + how);
    phase_ = Phase::none;
    return false;  // it is started again as ever
  }
  if (phase_ == Phase::beginning && !failure_)
    failure_ = fail(Code::unavailable, "process " + member.name() + " " + how);
  place_.policy.retire(member.index());
  (void)place_.policy.ended(member.index(), true, Moment::clock::now());
  return true;
}

// Ends the processes, and waits until they have.
void Renewal::end_all(Phase phase) {
  phase_ = phase;
  for (Member* const member : members()) {
    place_.policy.retire(member->index());
    if (member->process() != nullptr) place_.end(*member, phase == Phase::ending && member->has_come_up());
  }
  conductor_.wait([this] { return place_.is_over() || has_ended(); });
}

// Lets the processes be started.
void Renewal::begin_all(Phase phase) {
  phase_ = phase;
  std::set<std::string> heirs;
  for (Member* const member : members()) {
    if (phase == Phase::beginning_again && finished_.contains(member->name())) continue;
    place_.policy.restart(member->index(), Moment::clock::now());
    for (const std::string& component : place_.starter.components_of(*member)) {
      place_.pardon(component);
      heirs.insert(component);
    }
  }
  place_.starter.pass_on_states(std::move(heirs));
}

Members Renewal::members() const {
  Members members = place_.roster.all();
  const bool is_back = phase_ == Phase::ending_again || phase_ == Phase::beginning_again;
  std::erase_if(members, [&](const Member* member) {
    return !wish_.processes.contains(member->name()) && !(is_back && others_.contains(member->name()));
  });
  return members;
}

bool Renewal::has_ended() const {
  return std::ranges::all_of(members(), [](const Member* member) { return member->process() == nullptr; });
}

bool Renewal::is_up() const {
  return std::ranges::all_of(members(), [this](const Member* member) {
    const bool stays_away = phase_ == Phase::beginning_again && finished_.contains(member->name());
    return stays_away || member->phase() == Member::Phase::up;
  });
}

}  // namespace orca::supervisor
