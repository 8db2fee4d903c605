// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/alarm_store.hpp"

#include <algorithm>

namespace orca::host {

std::uint64_t AlarmStore::take(const idl::Alarm& alarm, const std::string& process) {
  const auto same = std::ranges::find_if(kept_, [&](const KeptAlarm& kept) {
    return kept.process == process && are_about_the_same(kept.alarm, alarm);
  });
  if (same != kept_.end()) {
    same->alarm = alarm;
    if (alarm.active()) ++same->times;
    return same->number;
  }
  if (!alarm.active()) return 0;
  if (kept_.size() == kMost) {
    kept_.erase(kept_.begin());
    ++given_up_;
  }
  kept_.push_back({++last_number_, process, alarm});
  return last_number_;
}

Status AlarmStore::acknowledge(std::uint64_t number) {
  const auto found = std::ranges::find(kept_, number, &KeptAlarm::number);
  if (found == kept_.end())
    return fail(Code::not_found, "there is no alarm " + std::to_string(number) + " to acknowledge");
  kept_.erase(found);
  return ok();
}

}  // namespace orca::host
