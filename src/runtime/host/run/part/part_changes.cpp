// SPDX-License-Identifier: LGPL-3.0-or-later
#include "part_changes.hpp"

#include <utility>

#include "orca/graph/plan.hpp"
#include "orca/graph/settings.hpp"
#include "orca/plugin/describe.hpp"
#include "run/swap/rewiring.hpp"

namespace orca::host {

Error no_such(const graph::PortRef& port) {
  return fail(Code::not_found, "there is no port " + port.text() + " in this process");
}

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
  whole_.graph.components.push_back(std::move(node));
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
  if (swaps_.is_under_way(name) || swaps_.concern_drivers())
    return fail(Code::failed_precondition, "its code, or a driver, is being exchanged", name);
  std::unique_ptr<ComponentInstance> rest;
  if (watched_.system().component(name) != nullptr) {
    Result<std::unique_ptr<ComponentInstance>> removed = watched_.system().remove(name, limit);
    if (!removed) return removed.error();
    rest = std::move(removed).value();
    last(*rest);
  }
  const std::lock_guard lock(whole_.mutex);
  offers_.forget(name);
  rest.reset();
  std::erase_if(whole_.graph.components, [&](const auto& node) { return node.name == name; });
  swaps_.forget(name);
  return ok();
}

Status PartChanges::rewire(const std::shared_ptr<std::vector<ConnectionChange>>& changes, TimePoint limit) {
  for (const ConnectionChange& change : *changes) {
    if (const Status done = rewire({changes, &change}, limit); !done.ok()) return done;
    const std::lock_guard lock(whole_.mutex);
    graph::put(change.edge, change.makes, whole_.graph.edges);
  }
  return ok();
}

// The change is kept for as long as a strand may still come to it.
Status PartChanges::rewire(const std::shared_ptr<const ConnectionChange>& change, TimePoint limit) {
  System& system = watched_.system();
  const graph::Edge& edge = change->edge;
  if (edge.link == graph::Link::local)
    return host::rewire(system, edge, change->makes, watched_.changed(), limit);
  const graph::PortRef& here = outer_.end_here(edge);
  Endpoint* const port = system.endpoint(here);
  if (port == nullptr) return no_such(here);
  return system.on_strand(here.component, watched_.changed(), limit, [this, change, port] {
    return change->makes ? outer_.make(change->edge, change->memory, *port)
                         : outer_.remove(change->edge, *port);
  });
}

}  // namespace orca::host
