// SPDX-License-Identifier: LGPL-3.0-or-later
#include "part_changes.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "orca/graph/plan.hpp"
#include "orca/graph/settings.hpp"
#include "orca/plugin/describe.hpp"

namespace orca::host {

PartChanges::PartChanges(std::string process, Whole whole, PluginCatalogue& catalogue, WatchedSystem& watched,
                         OuterEdges& outer, OuterOffers& offers, Swaps& swaps)
    : process_(std::move(process)),
      whole_(whole),
      catalogue_(catalogue),
      watched_(watched),
      outer_(outer),
      offers_(offers),
      swaps_(swaps) {}

Status PartChanges::add(graph::ComponentNode node, const std::map<std::string, std::string>& params) {
  outer_.learn(node);
  if (node.process == process_) {
    Result<graph::Params> read = read_params(node, params);
    if (!read) return read.error();
    node.params = std::move(read).value();
    if (Status added = watched_.system().add(node, catalogue_); !added.ok()) return added;
  }
  const std::lock_guard lock(whole_.mutex);
  std::vector<graph::ComponentNode>& all = whole_.graph.components;
  const auto known = std::ranges::find(all, node.name, &graph::ComponentNode::name);
  if (known != all.end())
    *known = std::move(node);  // it is in another process now
  else
    all.push_back(std::move(node));
  return ok();
}

Result<graph::Params> PartChanges::read_params(const graph::ComponentNode& node,
                                               const std::map<std::string, std::string>& texts) {
  const Result<LoadedType> type = catalogue_.acquire(PluginKind::component, node.type);
  if (!type) return type.error();
  HardwarePlace* const hardware = watched_.system().hardware(node.hardware);
  const Result<Contract> contract = plugin::describe_component(
      *type->entry, type->file(), hardware != nullptr ? &hardware->seat() : nullptr);
  if (!contract) return contract.error();
  std::vector<ParamContract> params = contract->params;
  for (ParamContract& param : params) param.fixed = false;  // it does not run yet
  return graph::read_settings(params, texts);
}

Status PartChanges::open_gate(const std::string& name) {
  const Result<ComponentInstance*> component = watched_.system().instance(name);
  if (!component) return component.error();
  (*component)->open_gate();
  return ok();
}

Status PartChanges::remove(const std::string& name, TimePoint limit,
                           const std::function<void(const ComponentInstance&)>& last) {
  const graph::ComponentNode* const node = whole_.graph.find_component(name);
  if (swaps_.is_under_way(name) || (node != nullptr && swaps_.is_under_way(node->hardware)))
    return fail(Code::failed_precondition, "its code, or its driver, is being exchanged", name);
  if (Status unconnected = check_unconnected(name); !unconnected.ok()) return unconnected;
  std::unique_ptr<ComponentInstance> rest;
  if (watched_.system().component(name) != nullptr) {
    Result<std::unique_ptr<ComponentInstance>> removed = watched_.system().remove(name, limit);
    if (!removed) return removed.error();
    rest = std::move(removed).value();
    last(*rest);
  }
  forget(name);
  rest.reset();  // a destructor may take long, and other threads must not wait for it
  return ok();
}

void PartChanges::forget(const std::string& component) {
  const std::lock_guard lock(whole_.mutex);
  offers_.forget(component);
  std::erase_if(whole_.graph.components, [&](const auto& node) { return node.name == component; });
  swaps_.forget(component);
}

// A removed component's ports must not be used by a connection that a failed change has left here.
Status PartChanges::check_unconnected(const std::string& component) const {
  const System& system = watched_.system();
  for (const graph::Edge& edge : whole_.graph.edges) {
    const bool is_its = edge.from.component == component || edge.to.component == component;
    const bool ends_here = system.endpoint(edge.from) != nullptr || system.endpoint(edge.to) != nullptr;
    if (is_its && ends_here)
      return fail(Code::failed_precondition, "the connection " + edge.name() + " could not be removed",
                  component);
  }
  return ok();
}

// All changes are carried out in one go on one strand, so that they are made together or not at all.
Status PartChanges::rewire(const std::vector<ConnectionChange>& changes, TimePoint limit) {
  std::string component;
  std::vector<std::function<Status()>> bodies;
  for (const ConnectionChange& change : changes) {
    Result<Rewiring> rewiring = prepare(change);
    if (!rewiring) return rewiring.error();
    if (!bodies.empty() && rewiring->component != component)
      return fail(Code::invalid_argument,
                  "one order cannot change connections of both " + component + " and " + rewiring->component);
    component = std::move(rewiring->component);
    bodies.push_back(std::move(rewiring->body));
  }
  const Status done = watched_.system().on_strand(component, watched_.changed(), limit, [bodies] {
    for (const auto& body : bodies)
      if (Status changed = body(); !changed.ok()) return changed;
    return ok();
  });
  if (!done.ok()) return done;
  const std::lock_guard lock(whole_.mutex);
  for (const ConnectionChange& change : changes) graph::put(change.edge, change.makes, whole_.graph.edges);
  return ok();
}

Result<Rewiring> PartChanges::prepare(const ConnectionChange& change) {
  const graph::Edge& edge = change.edge;
  if (edge.link == graph::Link::local) return rewiring_of(watched_.system(), edge, change.makes);
  if (Status known = outer_.check_known(edge); !known.ok()) return known.error();
  const graph::PortRef& here = outer_.end_here(edge);
  Endpoint* const port = watched_.system().endpoint(here);
  if (port == nullptr) return no_such(here);
  if (!change.makes)
    return Rewiring{here.component, [this, edge, port] {
                      outer_.remove(edge, *port);
                      return ok();
                    }};
  Result<RingSegment> segment = RingSegment::map(change.memory.number());
  if (!segment) return segment.error();
  return Rewiring{here.component,
                  [this, edge, port, memory = std::make_shared<RingSegment>(std::move(segment).value())] {
                    outer_.make(edge, std::move(*memory), *port);
                    return ok();
                  }};
}

}  // namespace orca::host
