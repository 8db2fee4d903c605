// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hardware_loop.hpp"

#include <algorithm>
#include <typeinfo>

#include "orca/base/activity.hpp"
#include "orca/base/exception_text.hpp"

namespace orca::hw {
namespace {

constexpr Duration kExpiryReportPeriod = 10s;

}  // namespace

HardwareLoop::HardwareLoop(HardwareContainer& container, HardwareHost& host)
    : container_(container), host_(host), life_(container, host) {}

void HardwareLoop::run() {
  shutting_down_.store(false, std::memory_order_release);
  strand_.emplace(host_.executive(), TaskOptions{host_.name(), 1});
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
  guarded([this] { life_.handle(HardwareEvent::begun); });
  while (!shutting_down_.load(std::memory_order_acquire)) guarded([this] { turn(); });
  guarded([this] { life_.handle(HardwareEvent::unwanted); });
  guarded([this] { life_.handle(HardwareEvent::shut_down); });
}

void HardwareLoop::turn() {
  life_.handle(users_.load() > 0 ? HardwareEvent::wanted : HardwareEvent::unwanted);
  apply_motion();
  if (works() && host_.now() >= container_.next_poll())
    if (const Status polled = container_.poll(); !polled.ok()) life_.fail_with(polled.error().text());
  host_.pausing();
  strand_->pause_until(next_turn());
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
  if (motion.expired_count() != expired) report_expiry(motion);
}

// Reports that the commands have ceased, now and then while that goes on happening.
void HardwareLoop::report_expiry(const MotionHW& motion) {
  if (host_.now() < next_expiry_report_) return;
  next_expiry_report_ = host_.now() + kExpiryReportPeriod;
  const auto age = std::chrono::duration_cast<std::chrono::milliseconds>(motion.max_command_age());
  host_.write_log(log::Level::warning,
                  "the base stands: no motion command for " + std::to_string(age.count()) + " ms");
}

bool HardwareLoop::works() const {
  return life_.state() == HardwareState::ready || life_.state() == HardwareState::active;
}

TimePoint HardwareLoop::next_turn() const {
  if (!works()) return kForever;
  const bool moves = life_.state() == HardwareState::active && container_.motion() != nullptr;
  return moves ? std::min(container_.next_poll(), container_.motion()->expiry()) : container_.next_poll();
}

}  // namespace orca::hw
