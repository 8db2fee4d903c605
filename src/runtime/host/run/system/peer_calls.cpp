// SPDX-License-Identifier: LGPL-3.0-or-later
#include "peer_calls.hpp"

#include "orca/graph/print.hpp"

namespace orca::host {
namespace {

constexpr Duration kObeyInTime = 5s;

// Returns the value before.
Result<std::string> set(const std::string& by, const PeerOrder& order, WatchedSystem& watched) {
  const std::string& component = order.component;
  const std::string& param = order.param;
  const Result<ComponentInstance*> target = watched.system().instance(component);
  if (!target) return target.error();
  const ParamValues values = (*target)->parts().params.values();
  const auto before = values.find(param);
  if (before == values.end()) return fail(Code::not_found, "it has no parameter " + param, component);
  const Status done = watched.system().set_params(component, {{param, order.value}}, watched.changed(),
                                                  watched.executive().now() + kObeyInTime);
  if (!done.ok()) return done.error();
  watched.reporter().log(
      log::Level::info, component,
      by + " has set " + param + " to " + graph::print_value((*target)->parts().params.values().at(param)));
  return graph::print_value(before->second);
}

Result<bool> pause(const PeerCall& call, bool suspends, WatchedSystem& watched) {
  const std::string& component = call.order.component;
  const Result<ComponentInstance*> target = watched.system().instance(component);
  if (!target) return target.error();
  if (is_suspended((*target)->report().state) == suspends) return false;
  const TimePoint limit = watched.executive().now() + kObeyInTime;
  System& system = watched.system();
  const Status done = suspends ? system.suspend(component, watched.changed(), limit)
                               : system.resume(component, watched.changed(), limit);
  if (!done.ok()) return done.error();
  watched.reporter().log(log::Level::info, component,
                         call.by + (suspends ? " has suspended it" : " has let it go on"));
  return true;
}

Result<std::string> carry_out(const PeerCall& call, WatchedSystem& watched) {
  if (call.order.kind == PeerOrder::Kind::set) return set(call.by, call.order, watched);
  return watched.context().peer_pauses.obey(call,
                                            [&](bool suspends) { return pause(call, suspends, watched); });
}

// A component that cannot be let go on has ended itself.
void let_go(WatchedSystem& watched) {
  const auto report = [&](const std::string& name) {
    const Result<ComponentInstance*> component = watched.system().instance(name);
    return component ? (*component)->report() : ComponentReport{};
  };
  for (const PeerCall& call : watched.context().peer_pauses.left(report)) {
    watched.reporter().log(log::Level::warning, call.order.component,
                           "it was suspended for " + call.by + ", which has ended");
    if (!carry_out(call, watched)) watched.context().peer_pauses.forget(call.order.component);
  }
}

}  // namespace

void carry_out_peer_orders(WatchedSystem& watched) {
  for (const auto& component : watched.system().components().all())
    while (const auto order = component->parts().peer_orders->take_order())
      component->parts().peer_orders->conclude(
          order->first, carry_out({component->name(), order->first, order->second}, watched));
  let_go(watched);
}

}  // namespace orca::host
