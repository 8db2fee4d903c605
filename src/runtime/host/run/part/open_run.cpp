// SPDX-License-Identifier: LGPL-3.0-or-later
#include "open_run.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "orca/base/exhaustion.hpp"
#include "run/swap/rewiring.hpp"

namespace orca::host {
namespace {

constexpr Duration kObeyLimit = 5s;

}  // namespace

OpenRun::OpenRun(Parts run, RunVisitors& visitors)
    : run_(std::move(run)),
      visitors_(visitors),
      ports_(run_.watched.executive(), &run_.watched.context().missions),
      orders_([this] { run_.watched.changed().notify(); }) {
  run_.watched.reporter().tap(ports_.taps());
}

void OpenRun::came_up() {
  report_changes();
  visitors_.came_up();
}

bool OpenRun::obey() {
  report_changes();
  while (std::optional<PartOrder> order = orders_.take()) carry_out(*order);
  return orders_.is_to_end();
}

void OpenRun::carry_out(PartOrder& order) {
  if (order.kind == PartOrder::Kind::swap) return run_.swaps.begin(std::move(*order.swap), order.swapped);
  const Status outcome = contain_exhaustion([&] { return act(order); });
  report_changes();
  if (order.done) order.done(outcome);
}

Status OpenRun::act(const PartOrder& order) {
  Event& changed = run_.watched.changed();
  const TimePoint limit = run_.watched.executive().now() + kObeyLimit;
  switch (order.kind) {
    case PartOrder::Kind::suspend: return system().suspend(order.component, changed, limit);
    case PartOrder::Kind::resume: return system().resume(order.component, changed, limit);
    case PartOrder::Kind::set_params:
      return system().set_params(order.component, order.params, changed, limit);
    case PartOrder::Kind::check_unused: return system().check_unused();
    case PartOrder::Kind::take_down: return ok();  // the run itself does that
    default:
      return fail(Code::unimplemented,
                  "this run has one process from its beginning to its end, and its "
                  "graph stays as it is; --change gives a run another one");
  }
}

void OpenRun::report_changes() {
  for (const auto& component : system().components().all()) {
    const ComponentReport report = component->report();
    const auto [known, is_new] = reported_.try_emplace(component->name(), report);
    if (!is_new && known->second == report) continue;
    known->second = report;
    visitors_.component_changed(component->name(), report);
  }
}

RunGlance OpenRun::look() const {
  RunGlance glance;  // the rest is in the view that the run's own listener has
  for (RunGlance::Unwell& unwell : system().unwell())
    if (run_.graph.find_hardware(unwell.name) != nullptr) glance.unwell.push_back(std::move(unwell));
  return glance;
}

Result<std::shared_ptr<PortTap>> OpenRun::tap(const std::vector<graph::PortRef>& ports,
                                              const PortTap::Bounds& bounds) {
  return ports_.tap(system(), ports, bounds, [this](const graph::PortRef& port) {
    const graph::ComponentNode* const node = run_.graph.find_component(port.component);
    return node != nullptr && node->watchable;  // the order of all others stays as it is
  });
}

Status OpenRun::offer(const graph::PortRef& port, ObjectLoan object,
                      std::function<void(Result<ObjectRef>)> answered) {
  return ports_.offer(system(), port, std::move(object), std::move(answered));
}

void OpenRun::hear(const idl::Alarm& alarm, const std::string& process) {
  run_.watched.reporter().alarm_news().add(alarm, process);
}

void OpenRun::forget_alarm(const std::string& kind, const std::string& source, const std::string& process) {
  run_.watched.reporter().alarm_news().acknowledge(kind, source, process);
}

Status OpenRun::renew_edge(const std::string& edge, const Descriptor& /*memory*/) {
  return fail(Code::not_found, "the edge " + edge + " leads to no other process");
}

Status OpenRun::move_edge(const std::string& edge) {
  const auto known = std::ranges::find(run_.graph.edges, edge, &graph::Edge::name);
  if (known == run_.graph.edges.end()) return fail(Code::not_found, "an edge that the graph does not have");
  return host::move(system(), *known);
}

}  // namespace orca::host
