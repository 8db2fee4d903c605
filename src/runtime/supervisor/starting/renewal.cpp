// SPDX-License-Identifier: LGPL-3.0-or-later
#include "renewal.hpp"

#include <algorithm>
#include <utility>

#include "orca/base/log.hpp"

namespace orca::supervisor {

void Renewal::begin(Wish wish, Done done) {
  wish_ = std::move(wish);
  done_ = std::move(done);
  failure_.reset();
  others_.clear();
  finished_.clear();
  for (const Member* const member : members())
    if (place_.policy.has_finished(member->index())) finished_.insert(member->name());
  place_.starter.forget_old_states();
  phase_ = Phase::ending;
  end_all();
}

void Renewal::turn(Moment now) {
  switch (phase_) {
    case Phase::none: return;
    case Phase::ending:
    case Phase::ending_again:
      if (!has_ended()) return;
      phase_ == Phase::ending ? wish_.go() : wish_.go_back();
      phase_ = phase_ == Phase::ending ? Phase::beginning : Phase::beginning_again;
      return start_all(now);
    case Phase::beginning:
      if (now >= limit_ && !failure_)
        failure_ = fail(Code::deadline_exceeded, "not everything came up in time");
      if (failure_) return go_back(*failure_);
      return is_up() ? finish(ok()) : void();
    case Phase::beginning_again:
      if (is_up() || now >= limit_) finish(*failure_);
  }
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
    finish(fail(failure_->code, failure_->text() + "; and process " + member.name() + " " + how));
    return false;  // it is started again as ever
  }
  if (phase_ == Phase::beginning && !failure_)
    failure_ = fail(Code::unavailable, "process " + member.name() + " " + how);
  place_.policy.retire(member.index());
  (void)place_.policy.ended(member.index(), true, Moment::clock::now());
  return true;
}

// The states that count are those of the first end: code that was there for a moment only may have written others.
void Renewal::end_all() {
  for (Member* const member : members()) {
    place_.policy.retire(member->index());
    if (member->process() != nullptr) place_.end(*member, phase_ == Phase::ending && member->has_come_up());
  }
}

void Renewal::start_all(Moment now) {
  if (phase_ == Phase::beginning) states_ = place_.starter.states();
  if (phase_ == Phase::beginning_again) place_.starter.set_states(states_);
  std::set<std::string> heirs;
  for (Member* const member : members()) {
    if (phase_ == Phase::beginning_again && finished_.contains(member->name())) continue;
    place_.policy.restart(member->index(), now);
    for (const std::string& component : place_.starter.components_of(*member)) {
      place_.pardon(component);
      heirs.insert(component);
    }
  }
  place_.starter.pass_on_states(std::move(heirs));
  limit_ = now + kStartLimit;
}

void Renewal::go_back(const Error& reason) {
  failure_ = reason;
  phase_ = Phase::ending_again;
  end_all();
}

void Renewal::finish(const Status& outcome) {
  phase_ = Phase::none;
  std::exchange(done_, nullptr)(outcome);
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
