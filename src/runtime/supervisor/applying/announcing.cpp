// SPDX-License-Identifier: LGPL-3.0-or-later
#include "applying/announcing.hpp"

#include <algorithm>

namespace orca::supervisor {
namespace {

// Returns the components of processes which begin anew that the others do not know yet, or know elsewhere.
std::vector<graph::ComponentNode> newcomers_in(const std::set<std::string>& processes,
                                               const graph::Graph& running, const graph::Graph& wanted) {
  std::vector<graph::ComponentNode> newcomers;
  for (const graph::ComponentNode& node : wanted.components) {
    const graph::ComponentNode* const before = running.find_component(node.name);
    const bool is_known_there = before != nullptr && before->process == node.process;
    if (processes.contains(node.process) && !is_known_there) newcomers.push_back(node);
  }
  return newcomers;
}

// Returns the processes that stay while others begin anew.
Members staying(const Members& all, const std::set<std::string>& renewed) {
  Members members = all;
  std::erase_if(members, [&](const Member* member) { return renewed.contains(member->name()); });
  return members;
}

// Tells processes of components that others have, so that connections to them can be made. A process that is just coming
// up has not heard of it.
Status announce(const std::vector<AddComponent>& components, const std::vector<Member*>& all) {
  const auto coming = std::ranges::find(all, Member::Phase::coming_up, &Member::phase);
  if (coming != all.end())
    return fail(Code::unavailable, "process " + (*coming)->name() + " is just coming up; try again later");
  for (const AddComponent& component : components)
    for (Member* const member : all)
      if (member->name() != component.node.process) member->tell(component);
  return ok();
}

}  // namespace

void announce_end(const std::string& component, const std::string& process, const std::vector<Member*>& all) {
  for (Member* const member : all)
    if (member->name() != process && member->is_built()) member->tell(RemoveComponent{component});
}

Result<std::vector<AddComponent>> Announcing::begin(const graph::GraphPlan& plan,
                                                    const graph::Graph& wanted) {
  renewed_ = plan.renewed;
  newcomers_ = newcomers_in(renewed_, running_, wanted);
  gone_ = newcomers_in(renewed_, wanted, running_);
  std::erase_if(gone_, [&](const auto& node) { return wanted.find_component(node.name) != nullptr; });
  Result<std::vector<AddComponent>> orders = orders_for(plan.added);
  if (!orders) return orders.error();
  if (const Status told = announce(*orders, staying(all_, renewed_)); !told.ok()) return told.error();
  const auto elsewhere = orders_for(newcomers_);
  if (!elsewhere) return elsewhere.error();
  if (const Status told = tell(*elsewhere, wanted); !told.ok()) return told.error();
  return orders;
}

void Announcing::take_back() const {
  std::vector<graph::ComponentNode> moved;
  for (const graph::ComponentNode& node : newcomers_) {
    const graph::ComponentNode* const before = running_.find_component(node.name);
    if (before != nullptr) moved.push_back(*before);
    if (before == nullptr) announce_end(node.name, node.process, staying(all_, renewed_));
  }
  const auto orders = orders_for(moved);
  const auto notes = starter_.introduce_processes(running_, renewed_);
  for (Member* const member : staying(all_, renewed_)) {
    if (!member->is_built()) continue;  // it comes up with the graph of the run
    if (notes)
      for (const NoteProcess& note : *notes) member->tell(note);
    if (orders)
      for (const AddComponent& order : *orders)
        if (order.node.process != member->name()) member->tell(order);
  }
}

std::vector<std::string> Announcing::tell_of_the_gone() const {
  std::vector<std::string> names;
  for (const graph::ComponentNode& node : gone_) {
    announce_end(node.name, node.process, staying(all_, renewed_));
    names.push_back(node.name);
  }
  return names;
}

Result<std::vector<AddComponent>> Announcing::orders_for(
    const std::vector<graph::ComponentNode>& components) const {
  std::vector<AddComponent> orders;
  for (const graph::ComponentNode& node : components) {
    if (running_.find_component(node.name) == nullptr) ledger_.expect(node.name);
    Result<AddComponent> order = starter_.introduce(node);
    if (!order) return order.error();
    orders.push_back(std::move(order).value());
  }
  return orders;
}

Status Announcing::tell(const std::vector<AddComponent>& components, const graph::Graph& graph) const {
  const auto notes = starter_.introduce_processes(graph, renewed_);
  if (!notes) return notes.error();
  const Members stayers = staying(all_, renewed_);
  if (Status told = announce(components, stayers); !told.ok()) return told;
  for (Member* const member : stayers)
    for (const NoteProcess& note : *notes) member->tell(note);
  return ok();
}

}  // namespace orca::supervisor
