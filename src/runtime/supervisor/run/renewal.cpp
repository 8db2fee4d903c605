// SPDX-License-Identifier: LGPL-3.0-or-later
#include "renewal.hpp"

#include <algorithm>
#include <utility>

namespace orca::supervisor {
void Renewal::begin(Wish wish, Done done) {
  wish_ = std::move(wish);
  done_ = std::move(done);
  failure_.reset();
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

// What another process was started with while this is under way is the new graph, so it goes back, too.
bool Renewal::lose(const Member& member, const std::string& how) {
  if (phase_ == Phase::none) return false;
  if (!wish_.processes.contains(member.name())) {
    if (phase_ == Phase::beginning) wish_.processes.insert(member.name());
    return false;
  }
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

void Renewal::end_all() {
  for (Member* const member : members()) {
    place_.policy.retire(member->index());
    if (member->process() != nullptr) place_.end(*member);
  }
}

void Renewal::start_all(Moment now) {
  std::set<std::string> heirs;
  for (Member* const member : members()) {
    place_.policy.restart(member->index(), now);
    for (const std::string& component : place_.starter.components_of(*member)) heirs.insert(component);
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
  std::erase_if(members, [this](const Member* member) { return !wish_.processes.contains(member->name()); });
  return members;
}

bool Renewal::has_ended() const {
  return std::ranges::all_of(members(), [](const Member* member) { return member->process() == nullptr; });
}

bool Renewal::is_up() const {
  return std::ranges::all_of(members(),
                             [](const Member* member) { return member->phase() == Member::Phase::up; });
}

}  // namespace orca::supervisor
