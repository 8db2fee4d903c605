// SPDX-License-Identifier: LGPL-3.0-or-later
#include "member.hpp"

#include <unistd.h>

#include <string_view>

namespace orca::supervisor {
namespace {

constexpr std::string_view kLastWordsMark = "error: ";  // as host::LastWords writes them
constexpr Duration kDeafLimit = 200ms;  // from the loss of the channel to the end of a process
constexpr Duration kJustBefore =
    5s;  // a starved process takes long to die; older words tell of something else

}  // namespace

void Member::go_over(graph::ProcessNode node, std::size_t index) {
  node_ = std::move(node);
  index_ = index;
}

Status Member::start(const HostStart& start) {
  Result<std::unique_ptr<HostProcess>> started = HostProcess::start(start);
  if (!started) return started.error();
  process_ = std::move(started).value();
  phase_ = Phase::coming_up;
  starts_.last = Moment::clock::now();
  ++starts_.count;
  return ok();
}

void Member::adopt(std::unique_ptr<HostProcess> process) {
  process_ = std::move(process);
  enter(Phase::up);
  is_built_ = true;
  ++starts_.count;
}

void Member::enter(Phase phase) {
  if (phase == Phase::up && phase_ == Phase::coming_up) starts_.time = Moment::clock::now() - starts_.last;
  phase_ = phase;
  if (phase == Phase::up) has_come_up_ = true;
}

void Member::ask(Order order, Answered answered) {
  ask_for(std::move(order),
          [answered = std::move(answered)](const Answer& answer) { answered(answer.outcome); });
}

void Member::ask_for(Order order, AnswerTaker taker) {
  if (process_ == nullptr) return;
  open_.emplace(++last_request_, std::move(taker));
  (void)process_->channel().post(encode(std::move(order), last_request_));  // its end is seen elsewhere
}

void Member::tell(Order order) {
  if (process_ != nullptr) (void)process_->channel().post(encode(std::move(order)));
}

void Member::end(Moment now, const EndLimits& limits, Answered answered, bool keeps_states) {
  if (process_ == nullptr) return;
  phase_ = Phase::going_down;
  open_.emplace(++last_request_,
                [answered = std::move(answered)](const Answer& answer) { answered(answer.outcome); });
  process_->end(now, limits, last_request_, keeps_states);
}

void Member::take_answer(std::uint64_t request, const Answer& answer) {
  auto found = open_.extract(request);
  if (!found.empty()) found.mapped()(answer);
}

void Member::heard(const std::string& line, Moment now) {
  if (line.starts_with(kLastWordsMark)) heard_last_words(line.substr(kLastWordsMark.size()), now);
}

void Member::heard_last_words(const std::string& words, Moment now) {
  words_ = words;
  words_at_ = now;
}

void Member::look(Moment now) {
  if (process_ == nullptr) return;
  process_->look(now);
  if (phase_ == Phase::going_down) return;  // it has a limit for that, and ends its channel before itself
  const bool is_big = node_.memory && process_->memory().value_or(0) > *node_.memory;
  if (is_big) process_->end_by_force(Force::memory, now);
  if (deaf_since_ && now >= *deaf_since_ + kDeafLimit) process_->end_by_force(Force::channel, now);
}

std::string Member::last_words(Moment now) const { return now - words_at_ < kJustBefore ? words_ : ""; }

void Member::prompt(bool begins) {
  if (!begins) {
    pass_on_question();
    prompts_.reset();
  } else if (!prompts_) {
    prompts_.emplace();
  }
}

void Member::pass_on_question() {
  if (!prompts_ || process_ == nullptr) return;
  const std::string question = process_->take_unfinished_line();
  if (!question.empty() && write(STDERR_FILENO, question.data(), question.size()) < 0) prompts_.reset();
}

void Member::lose_channel(Moment now) {
  if (!deaf_since_) deaf_since_ = now;
}

void Member::forget() {
  const std::map<std::uint64_t, AnswerTaker> unanswered =
      std::move(open_);  // destroyed last: some act on that
  open_.clear();
  process_.reset();
  words_.clear();
  deaf_since_.reset();
  prompts_.reset();
  phase_ = Phase::absent;
  has_come_up_ = false;
  is_built_ = false;
}

}  // namespace orca::supervisor
