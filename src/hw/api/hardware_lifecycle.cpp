// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hardware_lifecycle.hpp"

namespace orca::hw {

std::string HardwareLifecycle::fault() const {
  const std::lock_guard lock(mutex_);
  return fault_;
}

void HardwareLifecycle::watch(Strand& strand) {
  const std::lock_guard lock(mutex_);
  watchers_.push_back(&strand);
}

void HardwareLifecycle::unwatch(const Strand& strand) {
  const std::lock_guard lock(mutex_);
  std::erase(watchers_, &strand);
}

void HardwareLifecycle::fail_with(const std::string& reason) { handle(failure(reason)); }

void HardwareLifecycle::drive(const DriveSetpoint& setpoint) {
  if (const FollowUp failed = checked(drive_to(setpoint))) handle(*failed);
}

void HardwareLifecycle::act() {
  for (ActuatorEndpoint* const actuator : container_.actuators())
    if (const FollowUp failed = checked(actuator->carry_out())) return handle(*failed);
}

void HardwareLifecycle::probe_again() {
  if (const FollowUp next = probe()) handle(*next);
}

void HardwareLifecycle::handle(HardwareEvent event) {
  for (FollowUp next = event; next;) {
    const HardwareTransition* const found = transition(state(), *next);
    next = found != nullptr ? carry_out(*found) : std::nullopt;
  }
}

HardwareLifecycle::FollowUp HardwareLifecycle::carry_out(const HardwareTransition& transition) {
  for (const HardwareAction action : transition.actions)
    if (const FollowUp next = carry_out(action, transition.to)) return next;
  return std::nullopt;
}

HardwareLifecycle::FollowUp HardwareLifecycle::carry_out(HardwareAction action, HardwareState to) {
  switch (action) {
    case HardwareAction::enter: enter(to); return std::nullopt;
    case HardwareAction::open: return checked(container_.open());
    case HardwareAction::probe: return probe();
    case HardwareAction::start: return checked(container_.start());
    case HardwareAction::halt: halt(to); return std::nullopt;
    case HardwareAction::stand: return checked(drive_to(applied_.stopped()));
    case HardwareAction::stop: container_.stop(); return std::nullopt;
    case HardwareAction::try_stop: try_stop(); return std::nullopt;
    case HardwareAction::forget: forget(); return std::nullopt;
    case HardwareAction::close: container_.close(); return std::nullopt;
  }
  return std::nullopt;
}

void HardwareLifecycle::enter(HardwareState state) {
  if (state == HardwareState::ready && !works_) note_work();
  if (state == HardwareState::fault) works_ = false;
  state_.store(state, std::memory_order_release);
  host_.state_changed(state);
  const std::lock_guard lock(mutex_);
  for (Strand* watcher : watchers_) watcher->wake();
}

void HardwareLifecycle::note_work() {
  works_ = true;
  reopens_.store(container_.recovers(), std::memory_order_release);
  if (!fault().empty()) host_.write_log(log::Level::warning, "it works again");
}

// A fault belongs to the mission in which it happened. Motors do not start again because a plug is back.
void HardwareLifecycle::halt(HardwareState to) {
  const bool failed = to == HardwareState::fault;
  if (failed)
    for (ActuatorEndpoint* const actuator : container_.actuators()) actuator->forget();
  constexpr const char* kFailed = "it has failed; orcactl estop --release lets it move again";
  if (failed && reopens()) container_.hold(kFailed);
  if (container_.motion() == nullptr) return;
  if (failed && reopens()) container_.motion()->hold(kFailed);  // nobody has ordered that
  container_.motion()->halt();
  if (!failed) container_.motion()->end_mission();
}

HardwareLifecycle::FollowUp HardwareLifecycle::probe() {
  const Result<bool> known = container_.probe();
  if (!known) return failure(known.error().text());
  return *known ? HardwareEvent::answered : HardwareEvent::unanswered;
}

void HardwareLifecycle::forget() {
  for (SensorEndpoint* sensor : container_.sensors()) sensor->forget();
}

// Stops the motors as far as possible: the device has failed in some way, but they may run and may still
// listen.
void HardwareLifecycle::try_stop() {
  try {
    applied_ = applied_.stopped();
    if (container_.motion() != nullptr && !container_.drive(applied_).ok())
      host_.write_log(log::Level::error, "the motors did not take the stop command either");
    container_.stop();
  } catch (...) {
    host_.write_log(log::Level::error, "the hardware plugin threw while it was stopped after a fault");
  }
}

Status HardwareLifecycle::drive_to(const DriveSetpoint& setpoint) {
  if (setpoint == applied_) return ok();
  applied_ = setpoint;
  return container_.drive(setpoint);
}

HardwareLifecycle::FollowUp HardwareLifecycle::checked(const Status& outcome) {
  if (outcome.ok()) return std::nullopt;
  return failure(outcome.error().text());
}

// A device that is still unplugged is no news.
HardwareEvent HardwareLifecycle::failure(const std::string& reason) {
  if (reopens() && !works_ && reason == fault()) return HardwareEvent::failed_again;
  report(reason);
  return HardwareEvent::failed;
}

// Makes a fault known; this is the only place that does so. The first fault stays until the device is opened again.
void HardwareLifecycle::report(const std::string& reason) {
  if (state() == HardwareState::fault || state() == HardwareState::backoff) return;
  {
    const std::lock_guard lock(mutex_);
    fault_ = reason;
  }
  host_.write_log(log::Level::error, reason);
}

}  // namespace orca::hw
