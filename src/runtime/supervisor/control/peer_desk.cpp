// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/peer_desk.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "orca/base/log.hpp"
#include "orca/host/component_state.hpp"

namespace orca::supervisor {
namespace {

using Act = PeerOrder::Kind;

// Returns what right a component lacks for an order, for people; empty: none. To let another one go on needs no right.
std::string lacking_right(const graph::ComponentNode* by, const PeerOrder& order) {
  const auto lacks = [&](const std::string& right, std::vector<std::string> graph::ComponentNode::*rights) {
    return by == nullptr || std::ranges::find(by->*rights, right) == (by->*rights).end();
  };
  const std::string param = order.component + "." + order.param;
  if (order.kind == Act::set && lacks(param, &graph::ComponentNode::may_set)) return "set " + param;
  if (order.kind == Act::suspend && lacks(order.component, &graph::ComponentNode::may_suspend))
    return "suspend " + order.component;
  return "";
}

}  // namespace

Status PeerDesk::take(const PeerCalled& called, const std::string& process) {
  if (operating_.process_of(called.by) != process)
    return fail(Code::data_loss, "it gives an order of " + called.by + ", which it does not have");
  const host::PeerCall call{
      called.by, called.number, {static_cast<Act>(called.act), called.component, called.param, called.value}};
  conductor_.begin("an order of " + call.by, [this, call] {
    const Result<std::string> before = obey(call);
    ConcludeCall end{call.by, call.number, before ? ok() : Status(before.error()), before ? *before : ""};
    operating_.tell(call.by, std::move(end));
  });
  return ok();
}

Result<std::string> PeerDesk::obey(const host::PeerCall& call) {
  const std::string lacks = lacking_right(graph_.find_component(call.by), call.order);
  if (!lacks.empty()) return fail(Code::failed_precondition, "the graph gives no right to " + lacks, call.by);
  if (call.order.kind == Act::set) return operating_.set_for(call.by, call.order);
  return pauses_.obey(call, [&](bool suspends) { return pause(call, suspends); });
}

Result<bool> PeerDesk::pause(const host::PeerCall& call, bool suspends) {
  const std::string& component = call.order.component;
  bool changes = false;
  const auto make = [&]() -> std::optional<ThereAndBack> {
    changes = host::is_suspended(reports_(component).state) != suspends;
    if (!changes) return std::nullopt;
    if (suspends) return ThereAndBack{Suspend{component}, Resume{component}};
    return ThereAndBack{Resume{component}, Suspend{component}};
  };
  const Status end = operating_.carry_out({{component, make, [](bool) {}}});
  if (!end.ok()) return end.error();
  if (changes) log::info(component, call.by + (suspends ? " has suspended it" : " has let it go on"));
  return changes;
}

void PeerDesk::go_on() {
  if (lets_go_) return;
  const std::vector<host::PeerCall> left = pauses_.left(reports_);
  if (left.empty()) return;
  lets_go_ = true;
  conductor_.begin("letting go on what was suspended", [this, left] {
    for (const host::PeerCall& call : left) {
      const std::string& component = call.order.component;
      if (host::is_suspended(reports_(component).state))
        log::warning(component, "it was suspended for " + call.by + ", which has ended");
      if (!obey(call))
        pauses_.forget(component);  // its process is lost, too, and begins again without a pause
    }
    lets_go_ = false;
  });
}

void PeerDesk::overrule(const std::string& name) {
  const auto components = names_.component_or_group(name);
  if (!components) return;
  for (const graph::ComponentNode* const component : *components) pauses_.forget(component->name);
}

}  // namespace orca::supervisor
