// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hardware_loop.hpp"

#include <algorithm>
#include <cstdio>
#include <typeinfo>
#include <utility>

#include "orca/base/activity.hpp"
#include "orca/base/exception_text.hpp"

namespace orca::hw {
namespace {

constexpr Duration kExpiryReportPeriod = 10s;
constexpr Duration kLate = 20ms;  // that a command may come late before it is reported that the base stands
constexpr Duration kFirstPause =
    500ms;  // before a device that has failed is opened again; then twice as long each time
constexpr Duration kLongestPause = 5s;
constexpr Duration kSteadyAfter = 10s;  // of work the pauses begin anew
constexpr Duration kInputPeriod = 5ms;  // of looks for input where it wakes nobody

}  // namespace

HardwareLoop::HardwareLoop(HardwareContainer& container, HardwareHost& host)
    : container_(container), host_(host), life_(container, host) {}

void HardwareLoop::run() {
  shutting_down_.store(false, std::memory_order_release);
  strand_.emplace(host_.executive(), TaskOptions{host_.name(), 1});
  hears_input_ = strand_->await_input();
  life_.handle(HardwareEvent::run);
  strand_->start([this] { main(); });
}

void HardwareLoop::shut_down() {
  shutting_down_.store(true, std::memory_order_release);
  wake();
}

bool HardwareLoop::join_until(TimePoint deadline) { return !strand_ || strand_->join_until(deadline); }

void HardwareLoop::acquire() {
  users_.fetch_add(1);
  wake();
}

void HardwareLoop::release() {
  users_.fetch_sub(1);
  wake();
}

void HardwareLoop::wake() {
  if (strand_) strand_->wake();
}

void HardwareLoop::main() {
  const Activity activity(host_.name().c_str(), Hook::strand, &typeid(container_));
  guarded([this] { open(); });
  while (!shutting_down_.load(std::memory_order_acquire)) guarded([this] { turn(); });
  guarded([this] { life_.handle(HardwareEvent::unwanted); });
  guarded([this] { life_.handle(HardwareEvent::shut_down); });
  if (std::exchange(told_hold_, std::nullopt)) host_.held(std::nullopt);  // a driver that goes holds nothing
}

void HardwareLoop::turn() {
  life_.handle(users_.load() > 0 ? HardwareEvent::wanted : HardwareEvent::unwanted);
  apply_motion();
  if (life_.state() == HardwareState::active) life_.act();
  if (is_open()) attend();
  report_hold();
  reopen();
  host_.pausing();
  strand_->watch_input(is_open() ? container_.descriptor() : -1);
  strand_->pause_until(next_turn());
}

void HardwareLoop::open() {
  opened_ = last_heard_ = host_.now();
  record_.opened();
  life_.handle(HardwareEvent::begun);
  if (works()) record_.answered();
}

void HardwareLoop::attend() {
  const bool due = container_.hears_input() || host_.now() >= container_.next_poll();
  if (life_.state() == HardwareState::probing) {
    if (due) life_.probe_again();
    last_heard_ = host_.now();
    if (works()) record_.answered();
    return;
  }
  if (due) poll();
  check_silence();
}

void HardwareLoop::poll() {
  const Status polled = container_.poll();
  record_.count(container_.counts());
  if (!polled.ok()) life_.fail_with(polled.error().text());
}

void HardwareLoop::check_silence() {
  if (!works()) return;
  if (host_.now() < silence_ends()) return;
  char text[120];
  std::snprintf(text, sizeof text,
                "nothing has come from it for %.3g s; is it still connected and switched on?",
                to_seconds(container_.longest_silence()));
  life_.fail_with(text);
}

// Opens a device again that has failed, after a while.
void HardwareLoop::reopen() {
  if (life_.reopens()) life_.handle(HardwareEvent::may_recover);
  if (life_.state() != HardwareState::backoff) return retry_at_.reset();
  if (!retry_at_) {
    if (host_.now() - opened_ >= kSteadyAfter || pause_ == Duration{0}) pause_ = kFirstPause;
    retry_at_ = host_.now() + pause_;
    pause_ = std::min(2 * pause_, kLongestPause);
  }
  if (host_.now() < *retry_at_) return;
  retry_at_.reset();
  life_.handle(HardwareEvent::retry);
  open();
}

void HardwareLoop::guarded(const std::function<void()>& step) {
  try {
    step();
  } catch (...) {
    life_.fail_with("the hardware plugin " + describe_current_exception());
  }
}

void HardwareLoop::apply_motion() {
  if (container_.motion() == nullptr || life_.state() != HardwareState::active) return;
  MotionHW& motion = *container_.motion();
  const std::uint64_t expired = motion.expired_count();
  life_.drive(motion.due(host_.now()));
  if (motion.expired_count() != expired) expired_at_ = host_.now();
  if (expired_at_) report_expiry(motion);
}

// Reports that the commands have ceased, now and then while that goes on happening. A command that comes as the last one grows too old, because
// that is how often they come, has not ceased; nor has one to stand.
void HardwareLoop::report_expiry(const MotionHW& motion) {
  const bool goes_on = motion.last_command() >= *expired_at_;
  if (!goes_on && host_.now() < *expired_at_ + kLate) return;
  expired_at_.reset();
  if (goes_on || host_.now() < next_expiry_report_) return;
  next_expiry_report_ = host_.now() + kExpiryReportPeriod;
  const auto age = std::chrono::duration_cast<std::chrono::milliseconds>(motion.max_command_age());
  host_.write_log(log::Level::warning,
                  "the base stands: no motion command for " + std::to_string(age.count()) + " ms");
}

void HardwareLoop::report_hold() {
  if (container_.motion() == nullptr) return;
  std::optional<std::string> hold = container_.motion()->own_hold();
  if (hold == told_hold_) return;
  told_hold_ = std::move(hold);
  host_.held(told_hold_);
}

bool HardwareLoop::is_open() const { return works() || life_.state() == HardwareState::probing; }

bool HardwareLoop::works() const {
  return life_.state() == HardwareState::ready || life_.state() == HardwareState::active;
}

TimePoint HardwareLoop::silence_ends() const {
  return saturating_add(last_heard_, container_.longest_silence());
}

TimePoint HardwareLoop::next_turn() const {
  if (life_.state() == HardwareState::backoff) return retry_at_.value_or(host_.now());
  if (life_.state() == HardwareState::fault && life_.reopens()) return host_.now();
  if (!is_open()) return kForever;
  TimePoint next = container_.next_poll();
  if (container_.descriptor() >= 0 && !hears_input_) next = std::min(next, host_.now() + kInputPeriod);
  if (!works()) return std::max(next, host_.now() + kInputPeriod);  // input wakes it before
  next = std::min(next, silence_ends());
  const bool moves = life_.state() == HardwareState::active && container_.motion() != nullptr;
  if (!moves) return next;
  if (expired_at_) next = std::min(next, *expired_at_ + kLate);
  return std::min(next, container_.motion()->expiry());
}

}  // namespace orca::hw
