// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/peer_call.hpp"

namespace orca::host {
namespace {

bool has_ended(ComponentState state) {
  return state != ComponentState::connect && state != ComponentState::work && !is_suspended(state);
}

}  // namespace

Result<std::string> PeerPauses::obey(const PeerCall& call, const Pause& pause) {
  const std::string& component = call.order.component;
  const bool suspends = call.order.kind == PeerOrder::Kind::suspend;
  if (!suspends) {
    const auto held = holders_.find(component);
    if (held == holders_.end() || !held->second.contains(call.by)) return std::string(kPeerWorks);
    if (held->second.size() > 1) return held->second.erase(call.by), std::string(kPeerIsSuspended);
  }
  const Result<bool> changed = pause(suspends);
  if (!changed) return changed.error();
  if (!suspends) return holders_.erase(component), std::string(kPeerIsSuspended);
  if (!*changed && !holders_.contains(component)) return std::string(kPeerIsSuspended);  // by an operator
  const bool is_new = holders_[component].insert(call.by).second;
  return std::string(is_new || *changed ? kPeerWorks : kPeerIsSuspended);
}

std::vector<PeerCall> PeerPauses::left(const Reports& reports) const {
  std::vector<PeerCall> orders;
  for (const auto& [component, holders] : holders_)
    for (const std::string& holder : holders)
      if (has_ended(reports(holder).state))
        orders.push_back({holder, 0, {.kind = PeerOrder::Kind::resume, .component = component}});
  return orders;
}

}  // namespace orca::host
