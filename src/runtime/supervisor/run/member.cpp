// SPDX-License-Identifier: LGPL-3.0-or-later
#include "member.hpp"

namespace orca::supervisor {

Status Member::start(const HostStart& start) {
  Result<std::unique_ptr<HostProcess>> started = HostProcess::start(start);
  if (!started) return started.error();
  process_ = std::move(started).value();
  phase_ = Phase::coming_up;
  return ok();
}

void Member::ask(Order order, Answered answered) {
  if (process_ == nullptr) return;
  open_.emplace(++last_request_, std::move(answered));
  (void)process_->channel().post(encode(std::move(order), last_request_));  // its end is seen elsewhere
}

void Member::tell(Order order) {
  if (process_ != nullptr) (void)process_->channel().post(encode(std::move(order)));
}

void Member::end(Moment now, Answered answered) {
  if (process_ == nullptr) return;
  phase_ = Phase::going_down;
  open_.emplace(++last_request_, std::move(answered));
  process_->end(now, EndLimits{}, last_request_);
}

void Member::take_answer(std::uint64_t request, const Status& outcome) {
  auto found = open_.extract(request);
  if (!found.empty()) found.mapped()(outcome);
}

void Member::forget() {
  process_.reset();
  open_.clear();
  phase_ = Phase::absent;
}

}  // namespace orca::supervisor
