// SPDX-License-Identifier: LGPL-3.0-or-later
#include "peer_calls.hpp"

#include "orca/graph/print.hpp"

namespace orca::host {
namespace {

constexpr Duration kObeyInTime = 5s;

// Returns the value before.
Result<std::string> set(const std::string& by, const PeerSetting& setting, WatchedSystem& watched) {
  const auto& [component, param, value] = setting;
  const Result<ComponentInstance*> target = watched.system().instance(component);
  if (!target) return target.error();
  const ParamValues values = (*target)->params();
  const auto before = values.find(param);
  if (before == values.end()) return fail(Code::not_found, "it has no parameter " + param, component);
  const Status done = watched.system().set_params(component, {{param, value}}, watched.changed(),
                                                  watched.executive().now() + kObeyInTime);
  if (!done.ok()) return done.error();
  watched.reporter().log(
      log::Level::info, component,
      by + " has set " + param + " to " + graph::print_value((*target)->params().at(param)));
  return graph::print_value(before->second);
}

}  // namespace

void carry_out_peer_orders(WatchedSystem& watched) {
  for (const auto& component : watched.system().components().all())
    while (const auto order = component->parts().peer_orders->take_order())
      component->parts().peer_orders->conclude(order->first, set(component->name(), order->second, watched));
}

}  // namespace orca::host
