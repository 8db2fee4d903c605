// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/actuator.hpp"

namespace orca::hw {
namespace {

constexpr std::size_t kMostWaiting = 16;

}  // namespace

std::string ActuatorEndpoint::port_stem() const {
  const std::string type(type_.name);
  return device_.empty() ? type : device_ + "_" + type;
}

Status ActuatorEndpoint::command(ObjectRef command) {
  if (Status checked = check(command); !checked.ok()) return checked;
  const std::lock_guard lock(mutex_);
  if (held_) return fail(Code::unavailable, "it is held: " + *held_);
  if (waiting_.size() == kMostWaiting)
    return fail(Code::unavailable, "it has not carried out the last " + std::to_string(kMostWaiting) +
                                       " commands yet; send the next one later");
  waiting_.push_back(std::move(command));
  return ok();
}

void ActuatorEndpoint::hold(const std::string& reason) {
  const std::lock_guard lock(mutex_);
  held_ = reason;
  halts_ = true;
  waiting_.clear();
}

bool ActuatorEndpoint::let_go() {
  const std::lock_guard lock(mutex_);
  return std::exchange(held_, std::nullopt).has_value();
}

Status ActuatorEndpoint::carry_out() {
  std::unique_lock lock(mutex_);
  const bool halts = std::exchange(halts_, false);
  const std::vector<ObjectRef> waiting = std::exchange(waiting_, {});
  lock.unlock();
  if (halts)
    if (Status halted = halt(); !halted.ok()) return halted;
  for (const ObjectRef& command : waiting)
    if (Status done = act(command); !done.ok()) return done;
  return ok();
}

void ActuatorEndpoint::forget() {
  const std::lock_guard lock(mutex_);
  waiting_.clear();
}

}  // namespace orca::hw
