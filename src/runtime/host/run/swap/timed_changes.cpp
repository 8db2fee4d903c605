// SPDX-License-Identifier: LGPL-3.0-or-later
#include "timed_changes.hpp"

#include <algorithm>
#include <utility>

#include "orca/graph/print.hpp"
#include "orca/plugin/image.hpp"
#include "rewiring.hpp"
#include "run/system/component_making.hpp"

namespace orca::host {
namespace {

constexpr Duration kLapLimit = 10s;  // for a component to come to the end of its lap

}  // namespace

TimedChanges::TimedChanges(graph::Graph& graph, WatchedSystem& watched, PluginCatalogue& catalogue,
                           Executive& executive, const std::vector<TimedChange>& changes)
    : graph_(graph),
      watched_(watched),
      catalogue_(catalogue),
      executive_(executive),
      changes_(changes),
      swaps_(graph, watched.context(), catalogue, watched.system()) {}

Result<TimePoint> TimedChanges::go_on() {
  while (!error_ && next_ < changes_.size() && executive_.now() >= began_ + changes_[next_].at) {
    const TimedChange& change = changes_[next_++];
    watched_.reporter().log_info("changes to " + change.file);
    if (const Status done = carry_out(change); !done.ok()) note(change, done.error());
  }
  const TimePoint wake_up = swaps_.go_on();
  if (error_) return *error_;
  return next_ < changes_.size() ? std::min(wake_up, began_ + changes_[next_].at) : wake_up;
}

Status TimedChanges::carry_out(const TimedChange& change) {
  for (const graph::GraphPlan::Exchange& one : change.plan.exchanges) exchange(change, one);
  // A value may name what is connected only then, as the behaviours that a fuser requires.
  const bool are_set = set(change.plan.settings).ok();
  if (Status come = add(change.plan); !come.ok()) return come;
  if (Status changed = rewire(change.plan.connections_of(false)); !changed.ok()) return changed;
  if (!are_set)
    if (Status set_late = set(change.plan.settings); !set_late.ok()) return set_late;
  for (const graph::ComponentNode& node : change.plan.added)
    (*watched_.system().instance(node.name))->open_gate();
  return remove(change.plan.removed);
}

Status TimedChanges::set(const std::map<std::string, graph::Params>& settings) {
  for (const auto& [component, params] : settings) {
    Status set = watched_.system().set_params(component, graph::print_values(params), watched_.changed(),
                                              executive_.now() + kLapLimit);
    if (!set.ok()) return set;
  }
  return ok();
}

// A component finds its connections when it is configured, as at a start.
Status TimedChanges::add(const graph::GraphPlan& plan) {
  System& system = watched_.system();
  for (const graph::ComponentNode& node : plan.added) {
    if (Status made = system.add(node, catalogue_); !made.ok()) return made;
    graph_.components.push_back(node);
  }
  if (Status connected = rewire(plan.connections_of(true)); !connected.ok()) return connected;
  for (const graph::ComponentNode& node : plan.added) {
    Status configured = system.configure(node.name, watched_.changed(), executive_.now() + kLapLimit);
    if (!configured.ok()) return configured;
  }
  return ok();
}

Status TimedChanges::remove(const std::vector<std::string>& components) {
  for (const std::string& name : components) {
    if (swaps_.is_under_way(name))
      return fail(Code::failed_precondition, "its code is still being exchanged; let it go later", name);
    std::erase_if(graph_.components, [&](const auto& node) { return node.name == name; });
    const auto removed = watched_.system().remove(name, executive_.now() + kLapLimit);
    if (!removed) return removed.error();
    swaps_.forget(name);
  }
  return ok();
}

// First those that are made, so that a port that goes over to another server misses nothing.
Status TimedChanges::rewire(const std::vector<graph::GraphPlan::Rewiring>& connections) {
  for (const graph::GraphPlan::Rewiring& one : connections)
    if (one.after)
      if (Status made = rewire(*one.after, true); !made.ok()) return made;
  for (const graph::GraphPlan::Rewiring& one : connections)
    if (!one.after)
      if (Status removed = rewire(*one.before, false); !removed.ok()) return removed;
  return ok();
}

Status TimedChanges::rewire(const graph::Edge& edge, bool makes) {
  graph::put(edge, makes, graph_.edges);
  Result<Rewiring> rewiring = rewiring_of(watched_.system(), edge, makes,
                                          makes ? links_of(graph_, edge, watched_.context()) : LocalLinks());
  if (!rewiring) return rewiring.error();
  return watched_.system().on_strand(rewiring->component, watched_.changed(), executive_.now() + kLapLimit,
                                     std::move(rewiring->body));
}

// The type was tried out when its graph was checked.
void TimedChanges::exchange(const TimedChange& change, const graph::GraphPlan::Exchange& exchange) {
  Result<plugin::PluginImage> image = plugin::PluginImage::copy(change.plugins.at(exchange.type));
  if (!image) return note(change, image.error());
  SwapOrder order{exchange.component, std::move(image).value(), exchange.type,
                  graph::print_values(exchange.params)};
  order.trial = plugin::Trial::done;
  swaps_.begin(std::move(order), [this, &change](const Result<SwapReport>& outcome) {
    if (!outcome) note(change, outcome.error());
  });
}

Status TimedChanges::finish() {
  (void)swaps_.go_on();
  for (std::size_t i = next_; i < changes_.size(); ++i)
    watched_.reporter().log_warning("the run ended before its change to " + changes_[i].file);
  return error_ ? Status(*error_) : ok();
}

void TimedChanges::note(const TimedChange& change, const Error& error) {
  if (!error_)
    error_ = fail(error.code, "the change to " + change.file + " failed: " + error.message, error.where);
}

}  // namespace orca::host
