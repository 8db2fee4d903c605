// SPDX-License-Identifier: LGPL-3.0-or-later
#include "component_instance.hpp"

#include <utility>

namespace orca::host {

ComponentInstance::ComponentInstance(RunContext& run, ComponentSettings settings, Residency::Loader loader,
                                     Residency::Unloader unloader, Device* hardware)
    : parts_(run, std::move(settings), hardware),
      residency_(parts_, std::move(loader), std::move(unloader)),
      succession_(parts_, residency_),
      keeper_(parts_, residency_),
      life_(parts_, residency_, succession_, keeper_),
      loop_(parts_, residency_, life_, keeper_) {}

// Destroys the component first, because its destructor may still use any part.
ComponentInstance::~ComponentInstance() { (void)residency_.destroy(); }

void ComponentInstance::start(std::function<void()> first) {
  parts_.strand.start([this, first = std::move(first)] {
    if (first) first();
    loop_.run();
  });
}

std::shared_ptr<Order> ComponentInstance::order_suspend() {
  return parts_.orders.add([this] { return life_.suspend(); });
}

std::shared_ptr<Order> ComponentInstance::order_resume() {
  return parts_.orders.add([this] { return life_.resume(); });
}

std::shared_ptr<Order> ComponentInstance::order_params(ParamValues values) {
  return parts_.orders.add([this, values = std::move(values)] { return life_.change_params(values); });
}

std::shared_ptr<Order> ComponentInstance::order_state_check() {
  return parts_.orders.add([this] { return succession_.check_state(life_.state()); });
}

std::shared_ptr<Order> ComponentInstance::order_take_over(ComponentInstance& successor, bool fresh,
                                                          TakeOver& report) {
  return parts_.orders.add(
      [this, &successor, fresh, &report] { return life_.take_over(successor.residency_, fresh, report); });
}

std::shared_ptr<Order> ComponentInstance::order_rewiring(std::function<Status()> rewire) {
  return parts_.orders.add([this, rewire = std::move(rewire)] {
    Status rewired = rewire();
    loop_.watch_deadlines();
    return rewired;
  });
}

bool ComponentInstance::at_rest() const {
  return state() != ComponentState::connect && state() != ComponentState::work;
}

bool ComponentInstance::is_in_use() const {
  const ComponentState now = state();
  return (now != ComponentState::idle && now != ComponentState::unloaded) || parts_.ports.is_asked() ||
         *current_hook() != '\0';
}

}  // namespace orca::host
