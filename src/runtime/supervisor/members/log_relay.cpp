// SPDX-License-Identifier: LGPL-3.0-or-later
#include "log_relay.hpp"

#include <algorithm>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/supervisor/log_name.hpp"

namespace orca::supervisor {

LogRelay::LogRelay() : listener_([this](const log::Line& line) { note(line); }) {}

void LogRelay::set_source(const Member* source) {
  const MutexLock lock(mutex_);
  source_ = source;
}

void LogRelay::note_wish(const Member& member, bool is_wished) {
  const MutexLock lock(mutex_);
  if (is_wished)
    told_[&member] = most_told_;
  else
    told_.erase(&member);
}

void LogRelay::note(const log::Line& line) {
  const MutexLock lock(mutex_);
  if (entries_.size() == kMostLines) entries_.pop_front();
  const auto time = static_cast<std::uint64_t>(line.time.time_since_epoch().count());
  entries_.push_back(
      {++last_, source_, {line.level, std::string(line.who), shortened(line.text, kLongestLine), time}});
}

void LogRelay::pass_on(const Members& members) {
  for (Member* const member : members) {
    if (member->process() == nullptr) {
      note_wish(*member, false);
    } else if (!member->process()->channel().has_unsent()) {
      TellLines order = take_for(*member);
      if (!order.lines.empty()) member->tell(std::move(order));
    }
  }
}

TellLines LogRelay::take_for(const Member& member) {
  const MutexLock lock(mutex_);
  TellLines order;
  const auto wish = told_.find(&member);
  if (wish == told_.end()) return order;
  std::uint64_t& told = wish->second;
  if (!entries_.empty() && entries_.front().number > told + 1) {
    const std::uint64_t lost = entries_.front().number - told - 1;
    const LogLine& next = entries_.front().line;
    order.lines.push_back({log::Level::warning, kLogName,
                           std::to_string(lost) + " lines of other processes came too fast, and are left out",
                           next.time});
    told += lost;
  }
  for (const Entry& entry : entries_) {
    if (entry.number <= told) continue;
    if (order.lines.size() >= kMostAtOnce) break;
    told = entry.number;
    if (entry.source != &member) order.lines.push_back(entry.line);
  }
  most_told_ = std::max(most_told_, told);
  return order;
}

}  // namespace orca::supervisor
