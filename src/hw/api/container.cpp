// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/container.hpp"

#include <utility>

#include "hardware_loop.hpp"

namespace orca::hw {

HardwareContainer::HardwareContainer(HardwareHost& host)
    : host_(host), loop_(std::make_unique<HardwareLoop>(*this, host)) {}

HardwareContainer::~HardwareContainer() noexcept(false) {}  // clang 14 takes no "= default" here

void HardwareContainer::run() { loop_->run(); }

void HardwareContainer::shut_down() { loop_->shut_down(); }

bool HardwareContainer::join_until(TimePoint deadline) { return loop_->join_until(deadline); }

void HardwareContainer::acquire() { loop_->acquire(); }

void HardwareContainer::release() { loop_->release(); }

HardwareState HardwareContainer::state() const { return loop_->life().state(); }

std::string HardwareContainer::fault() const { return loop_->life().fault(); }

bool HardwareContainer::is_lost() const { return loop_->life().is_lost(); }

idl::DeviceStatistics HardwareContainer::statistics() const {
  idl::DeviceStatistics statistics;
  statistics.line(line_name_);
  statistics.state(std::string(to_string(state())));
  const bool works = state() == HardwareState::ready || state() == HardwareState::active;
  statistics.fault(works ? std::string() : fault());
  loop_->record().fill(statistics);
  return statistics;
}

void HardwareContainer::heard() { loop_->heard(); }

void HardwareContainer::heard(TimePoint sent) {
  loop_->heard();
  loop_->record().heard(host_.now() - sent);
}

void HardwareContainer::watch(Strand& strand, bool on) {
  on ? loop_->life().watch(strand) : loop_->life().unwatch(strand);
}

Status HardwareContainer::check_active() const {
  if (motion() == nullptr) return fail(Code::failed_precondition, host_.name() + " has nothing that moves");
  if (state() != HardwareState::active)
    return fail(Code::unavailable,
                host_.name() + " is " + to_string(state()) + ", not Active: nobody has started it");
  return ok();
}

Status HardwareContainer::command(ActuatorEndpoint& actuator, ObjectRef command) {
  const Status taken = actuator.command(std::move(command));
  if (taken.ok()) wake();
  return taken;
}

void HardwareContainer::hold(const std::string& reason) {
  for (ActuatorEndpoint* const actuator : actuators()) actuator->hold(reason);
  if (motion() != nullptr) motion()->hold_by_order(reason);
  wake();
}

bool HardwareContainer::let_go() {
  bool was_held = motion() != nullptr && motion()->let_go();
  for (ActuatorEndpoint* const actuator : actuators()) was_held = actuator->let_go() || was_held;
  wake();
  return was_held;
}

void HardwareContainer::wake() { loop_->wake(); }

}  // namespace orca::hw
