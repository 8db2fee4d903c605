// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/system/pace.hpp"

#include <algorithm>
#include <utility>

#include "orca/base/steady_clock.hpp"

namespace orca {
namespace {

constexpr Duration kMostLag =
    100ms;  // of a machine that cannot keep the pace; it does not catch up with more
constexpr double kLongestWait = 3600;  // [s] until the executive looks again

Duration scaled(Duration time, double factor) { return from_seconds(to_seconds(time) * factor); }

}  // namespace

Status Pace::set(double factor) {
  const bool is_kept = factor >= kSlowest && factor <= kFastest;
  if (factor != 0.0 && factor != kFast && !is_kept)
    return fail(Code::invalid_argument,
                "a pace is a number from 0.01 to 1000 (1: as fast as the clock), \"fast\", or 0 for a pause");
  const MutexLock lock(mutex_);
  begin_anew(factor);
  return ok();
}

Status Pace::step(Duration span) {
  if (span <= Duration{0}) return fail(Code::invalid_argument, "a step is a time above 0 s");
  const MutexLock lock(mutex_);
  const TimePoint from = step_end_ ? *step_end_ : time_at(steady_now());  // steps add up
  begin_anew(kFast);
  step_end_ = saturating_add(from, span);
  return ok();
}

void Pace::finish() {
  const MutexLock lock(mutex_);
  if (!finished_) finished_ = time_at(steady_now());
  begin_anew(kFast);
}

Pace::State Pace::look() const {
  const MutexLock lock(mutex_);
  return {step_end_ ? 0.0 : factor_, step_end_.has_value(), time_at(steady_now()), finished_};
}

std::optional<TimePoint> Pace::hold_before(TimePoint next) {
  const MutexLock lock(mutex_);
  const TimePoint wall = steady_now();
  next_ = next;
  if (step_end_ && !finished_ && next > *step_end_) {  // the step is over
    reached_ = *step_end_;
    begin_anew(0.0);
  }
  if (!since_wall_) since_wall_ = wall;
  if (!finished_ && factor_ != kFast && next > since_) {
    if (factor_ == 0.0) return kForever;
    const double wait = to_seconds(next - since_) / factor_;
    const TimePoint due =
        *since_wall_ + from_seconds(std::min(wait, to_seconds(wall - *since_wall_) + kLongestWait));
    if (due > wall) return due;
    if (wall - due > kMostLag) since_ = next, since_wall_ = wall;
  }
  reached_ = next;
  return std::nullopt;
}

void Pace::on_change(std::function<void()> changed) {
  const MutexLock lock(mutex_);
  changed_ = std::move(changed);
}

// A moment that the executive has not reached yet is not passed.
TimePoint Pace::time_at(TimePoint wall) const {
  if (factor_ == kFast || !since_wall_) return std::max(since_, reached_);
  const TimePoint meant = since_ + scaled(wall - *since_wall_, factor_);
  return std::max(since_, std::clamp(meant, reached_, std::max(reached_, next_)));
}

void Pace::begin_anew(double factor) {
  const TimePoint wall = steady_now();
  since_ = time_at(wall);
  since_wall_ = wall;
  factor_ = factor;
  step_end_.reset();
  if (changed_) changed_();
}

}  // namespace orca
