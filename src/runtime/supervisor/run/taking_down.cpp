// SPDX-License-Identifier: LGPL-3.0-or-later
#include "taking_down.hpp"

#include <algorithm>
#include <utility>

#include "orca/base/log.hpp"

namespace orca::supervisor {
namespace {

// If there is no hurry, and it has much to write.
constexpr EndLimits kLeisure{30s, 500ms};
constexpr EndLimits kOnItsWay{3s, 500ms};    // if it has not come up, so that it has nothing to write
constexpr EndLimits kImpatience{1s, 500ms};  // if somebody wants it to end who has waited already
// If that is asked for twice: time for the motors, and less than the deployer itself then has.
constexpr EndLimits kUrgency{150ms, 100ms};

// Ends a process by force that cannot end all its strands.
void taken_down(Member& member, const Status& outcome) {
  if (outcome.ok()) return;
  log::error(member.name(), outcome.error().text() + "; the process is ended without it");
  member.process()->end_by_force(Force::overdue, Moment::clock::now());
}

}  // namespace

void TakingDown::begin(Moment now) {
  hurries_ = stop_.requested();
  for (Member* const member : members_)
    member->end(now, hurries_ ? kHurry : (member->has_come_up() ? kLeisure : kOnItsWay),
                [member](const Status& outcome) { taken_down(*member, outcome); });
}

bool TakingDown::is_done(Moment now) {
  if (stop_.is_urgent()) {
    limit(now, kUrgency);
  } else if (!std::exchange(hurries_, stop_.requested()) && hurries_) {
    limit(now, kImpatience);
  }
  return std::ranges::none_of(members_, [](const Member* member) { return member->process() != nullptr; });
}

void TakingDown::limit(Moment now, const EndLimits& limits) const {
  for (Member* const member : members_)
    if (member->process() != nullptr) member->process()->end(now, limits);
}

}  // namespace orca::supervisor
