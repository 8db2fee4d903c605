// SPDX-License-Identifier: LGPL-3.0-or-later
#include "machines/messenger.hpp"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "members/listening.hpp"
#include "orca/base/log.hpp"
#include "orca/supervisor/log_name.hpp"

namespace orca::supervisor {
namespace {

constexpr Duration kPause = 500ms;  // from one start to the next, at least
constexpr Duration kHangLimit =
    2s;  // without an answer; a busy machine takes its time to load the network code

}  // namespace

Messenger::Messenger(HostStart start, std::string whom, Meet meet, Heard heard)
    : start_(std::move(start)),
      whom_(std::move(whom)),
      meet_(std::move(meet)),
      heard_(std::move(heard)),
      member_(graph::ProcessNode{.name = meet_.name}, 0, 0) {}

void Messenger::turn(Moment now) {
  if (member_.process() == nullptr) {
    if (!ends_ && now >= start_at_) start(now);
    return;
  }
  const auto take_report = [this](const Report& report) { return take(report); };
  listen(member_, take_report, now);
  if (!ends_ && now - answered_at_ > kHangLimit) member_.process()->end_by_force(Force::hang, now);
  member_.look(now);
  const std::optional<ExitReason> exit = member_.process()->exit();
  if (!exit) return;
  listen(member_, take_report, now);  // it may have said why
  report_end(*exit, now);
  member_.forget();
  speaks_since_.reset();
}

void Messenger::start(Moment now) {
  start_at_ = now + std::chrono::duration_cast<Moment::duration>(kPause);
  answered_at_ = now;
  const Status started = member_.start(start_);
  if (!started.ok()) return log::error(meet_.name, started.error().text());
  member_.ask(Meet(meet_), [this](const Status& outcome) {
    if (outcome.ok()) {
      speaks_since_ = Moment::clock::now();
      return last_error_.clear();
    }
    if (outcome.error().message != last_error_) log::error(meet_.name, outcome.error().text());
    last_error_ = outcome.error().message;
  });
}

// Answers are signs of life; they come for what say() has asked.
void Messenger::say(std::vector<std::byte> state, Moment now) {
  if (member_.process() == nullptr) return;
  member_.ask(Say{std::move(state)},
              [this, now](const Status&) { answered_at_ = std::max(answered_at_, now); });
}

Status Messenger::take(const Report& report) const {
  if (const auto* line = std::get_if<Logged>(&report)) {
    log::write(line->level, line->who, line->text);
    return ok();
  }
  const auto* heard = std::get_if<HeardReport>(&report);
  if (heard == nullptr) return fail(Code::data_loss, "it reports what only a part of the system can");
  heard_(heard->object);
  return ok();
}

void Messenger::report_end(const ExitReason& reason, Moment now) {
  if (ends_ || !last_error_.empty()) return;  // as it was told to, or it has said why
  const std::string words = member_.last_words(now);
  log::warning(kLogName, "process " + member_.name() + ", which speaks with " + whom_ + ", " + reason.text() +
                             (words.empty() ? "" : ": " + words));
}

void Messenger::end(Moment now) {
  ends_ = true;
  member_.end(now, EndLimits{}, [](const Status&) {});
}

}  // namespace orca::supervisor
