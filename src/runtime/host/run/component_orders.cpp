// SPDX-License-Identifier: LGPL-3.0-or-later
// What a component is asked for from outside: pausing it, and giving its parameters other values.
#include <utility>

#include "component_instance.hpp"

namespace orca::host {

std::shared_ptr<Order> ComponentInstance::order_suspend() {
  return enqueue([this] { return suspend(); });
}

std::shared_ptr<Order> ComponentInstance::order_resume() {
  return enqueue([this] { return resume(); });
}

std::shared_ptr<Order> ComponentInstance::order_params(std::map<std::string, ParamValue> values) {
  return enqueue([this, values = std::move(values)] { return change_params(values); });
}

std::shared_ptr<Order> ComponentInstance::enqueue(std::function<Status()> body) {
  auto order = std::make_shared<Order>(std::move(body));
  {
    const std::lock_guard lock(mutex_);
    if (takes_orders_) {
      orders_.push_back(order);
      order_waits_.store(true, std::memory_order_release);
    } else {
      order->refuse(fail(Code::failed_precondition, "it has ended", settings_.name));
    }
  }
  strand_.wake();
  return order;
}

bool ComponentInstance::carry_out_order() {
  std::shared_ptr<Order> order;
  {
    const std::lock_guard lock(mutex_);
    if (orders_.empty()) return false;
    order = std::move(orders_.front());
    orders_.pop_front();
    order_waits_.store(!orders_.empty(), std::memory_order_release);
  }
  order->carry_out();
  run_.changed();
  return true;
}

void ComponentInstance::refuse_orders() {
  const std::lock_guard lock(mutex_);
  takes_orders_ = false;
  for (const auto& order : orders_)
    order->refuse(fail(Code::failed_precondition, "it has ended", settings_.name));
  orders_.clear();
}

Status ComponentInstance::suspend() {
  const ComponentState before = state();
  if (before != ComponentState::idle && before != ComponentState::work)
    return fail(Code::failed_precondition,
                std::string("it is ") + to_string(before) + "; only IDLE and WORK can be suspended",
                settings_.name);
  before_suspension_ = before;
  if (const auto fault = call("suspend", [this] { loaded_->object->suspend(); });
      fault && !fault->interrupted) {
    fail_with("suspend", fault->text);
    return fail(Code::internal, "suspend() " + fault->text, settings_.name);
  }
  set_state(ComponentState::suspended);
  return ok();
}

Status ComponentInstance::resume() {
  if (state() != ComponentState::suspended)
    return fail(Code::failed_precondition, std::string("it is ") + to_string(state()) + ", not SUSPENDED",
                settings_.name);
  set_state(before_suspension_);
  next_lap_ = now();
  if (const auto fault = call("resume", [this] { loaded_->object->resume(); });
      fault && !fault->interrupted) {
    fail_with("resume", fault->text);
    return fail(Code::internal, "resume() " + fault->text, settings_.name);
  }
  return ok();
}

Status ComponentInstance::change_params(const std::map<std::string, ParamValue>& values) {
  const std::map<std::string, ParamValue> old = params();
  std::map<std::string, ParamValue> changed = old;
  for (const auto& [name, value] : values) changed[name] = value;
  Status accepted;
  if (loaded_ != nullptr) {
    apply(changed);
    const auto fault = call("params_changed", [&] { accepted = loaded_->object->params_changed(); });
    if (fault || !accepted.ok()) apply(old);
    if (fault && !fault->interrupted) fail_with("params_changed", fault->text);
    if (fault) return fail(Code::internal, "params_changed() " + fault->text, settings_.name);
  }
  if (!accepted.ok()) return accepted;
  const std::lock_guard lock(mutex_);
  values_ = std::move(changed);
  return ok();
}

void ComponentInstance::apply(const std::map<std::string, ParamValue>& values) {
  for (const ParamDeclaration& param : loaded_->params)
    if (const auto value = values.find(param.contract.name); value != values.end()) param.set(value->second);
}

}  // namespace orca::host
