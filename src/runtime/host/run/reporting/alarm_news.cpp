// SPDX-License-Identifier: LGPL-3.0-or-later
#include "alarm_news.hpp"

#include <algorithm>

namespace orca::host {

void AlarmNews::add(const idl::Alarm& alarm, const std::string& process) {
  const std::lock_guard lock(mutex_);
  store_.take(alarm, process);
  news_.push_back(alarm);
  if (news_.size() <= kMostNews) return;
  news_.pop_front();
  ++forgotten_;
}

void AlarmNews::acknowledge(const std::string& kind, const std::string& source, const std::string& process) {
  const std::lock_guard lock(mutex_);
  const auto known = std::ranges::find_if(store_.kept(), [&](const KeptAlarm& kept) {
    return kind_text(kept.alarm) == kind && kept.alarm.source() == source &&
           (kept.process.empty() || kept.process == process);
  });
  if (known != store_.kept().end()) (void)store_.acknowledge(known->number);
}

std::vector<idl::Alarm> AlarmNews::since(std::uint64_t& position) const {
  const std::lock_guard lock(mutex_);
  const auto first = static_cast<std::ptrdiff_t>(std::max(position, forgotten_) - forgotten_);
  position = forgotten_ + news_.size();
  return {news_.begin() + first, news_.end()};
}

std::vector<idl::Alarm> AlarmNews::kept() const {
  const std::lock_guard lock(mutex_);
  std::vector<idl::Alarm> alarms;
  for (const KeptAlarm& kept : store_.kept()) alarms.push_back(kept.alarm);
  return alarms;
}

}  // namespace orca::host
