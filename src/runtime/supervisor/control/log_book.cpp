// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/log_book.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "orca/base/text.hpp"

namespace orca::supervisor {
namespace {

constexpr const char* kLevels[] = {"debug", "info", "warning", "error", "off"};

Record record_of(TimePoint time, const char* level, const std::string& who, const std::string& text) {
  return {{"time", to_seconds(time), 3}, {"level", level}, {"who", who}, {"text", text}};
}

}  // namespace

LogBook::LogBook(std::function<TimePoint()> clock)
    : clock_(std::move(clock)), listener_([this](const log::Line& line) { note(line); }) {}

void LogBook::note(const log::Line& line) {
  const MutexLock lock(mutex_);
  if (entries_.size() == kMost) entries_.pop_front();
  entries_.push_back(
      {++last_, line.time, line.level, std::string(line.who), shortened(line.text, kLongestLine)});
}

void LogBook::tell(const Entry& entry, const LogWish& wish, Reply& reply) {
  if (entry.level < wish.level) return;
  if (!wish.who.empty() && std::ranges::find(wish.who, entry.who) == wish.who.end()) return;
  const std::uint64_t left_out = reply.take_left_out();
  if (left_out > 0)
    reply.add(
        record_of(entry.time, "warning", "orcactl", std::to_string(left_out) + " lines were left out here"));
  reply.add(record_of(entry.time, kLevels[static_cast<int>(entry.level)], entry.who, entry.text));
}

void LogBook::show(LogWish wish, const ReplyPtr& reply) {
  pass_on();  // so that nobody gets a line twice
  {
    const MutexLock lock(mutex_);
    for (const Entry& entry : entries_) tell(entry, wish, *reply);
    note_absent(wish, *reply);
  }
  if (wish.follows) followers_.push_back({std::move(wish), reply});
}

// A name that is misspelt has no lines, and neither has who has said nothing: the names that there are tell which.
void LogBook::note_absent(const LogWish& wish, Reply& reply) const {
  std::set<std::string> known;
  for (const Entry& entry : entries_) known.insert(entry.who);
  for (const std::string& who : wish.who)
    if (!known.contains(who))
      reply.note("none of the lines that are kept is of " + in_quotes(who) + "; there are lines of: " +
                 joined(std::vector<std::string>(known.begin(), known.end()), ", "));
}

std::map<std::string, double> LogBook::rates() {
  constexpr Duration kLately = 10s;
  constexpr Duration kShortest = 100ms;  // from the first line that is kept until now
  std::map<std::string, double> rates;
  const MutexLock lock(mutex_);
  if (entries_.empty()) return rates;
  const TimePoint now = clock_();
  const bool is_full = entries_.size() == kMost;
  const Duration span = is_full ? std::clamp(now - entries_.front().time, kShortest, kLately) : kLately;
  for (const Entry& entry : entries_)
    if (now - entry.time <= span) rates[entry.who] += 1.0 / to_seconds(span);
  return rates;
}

void LogBook::pass_on() {
  std::erase_if(followers_, [](const Follower& follower) { return follower.reply->is_in_vain(); });
  const MutexLock lock(mutex_);
  const auto first = std::ranges::find_if(entries_, [&](const Entry& e) { return e.number > passed_on_; });
  for (auto entry = first; entry != entries_.end(); ++entry)
    for (Follower& follower : followers_) tell(*entry, follower.wish, *follower.reply);
  passed_on_ = last_;
}

}  // namespace orca::supervisor
