// SPDX-License-Identifier: LGPL-3.0-or-later
#include <set>
#include <string>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/batch/inputs.hpp"
#include "orca/graph/loader.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/hw/drawable.hpp"
#include "orca/hw/scene.hpp"

namespace orca::batch {
namespace {

constexpr const char* kArgumentWithoutValue = "G012";  // of graphs
constexpr const char* kChange = "G074";
constexpr const char* kFailingNobody = "E016";
constexpr const char* kGoalNowhere = "E017";

// A run of a batch has one graph from its start to its end.
void refuse_changes(const std::vector<graph::PlannedChange>& changes, xml::Diagnostics& diagnostics) {
  for (const graph::PlannedChange& change : changes)
    diagnostics.error(
        kChange, change.position,
        "<change>: simbatch does not carry out changes; run this graph with deployer, or leave its profile "
        "out");
}

void refuse_unknown_failures(const World& world, const graph::Graph& graph, xml::Diagnostics& diagnostics) {
  for (const Failing& one : world.failing)
    if (graph.find_component(one.component) == nullptr)
      diagnostics.error(kFailingNobody, one.position,
                        "<fail>: the graph has no component " + in_quotes(one.component));
}

// Returns what a picture of the graph's simulated robots shows before they move.
Scene scene_at_start(const graph::Graph& graph, host::PluginCatalogue& catalogue) {
  Scene scene;
  for (const graph::HardwareNode& node : graph.hardware) {
    plugin::DescribedHardware* const closed = catalogue.closed_hardware({node.name, node.type, node.params});
    hw::Drawable* const drawable = closed == nullptr ? nullptr : closed->container().drawable();
    if (drawable != nullptr) drawable->draw(scene);
  }
  return scene;
}

void refuse_unknown_goals(const std::vector<Goal>& goals, const Scene& scene, xml::Diagnostics& diagnostics) {
  for (const Goal& goal : goals)
    if (const Status found = can_judge(goal, scene); !found.ok())
      diagnostics.error(kGoalNowhere, goal.declared_at, "<goal>: " + found.error().message);
}

// Returns the experiment as one that compares in the worlds of its tuner, too.
Experiment with_tuning_worlds(const Experiment& experiment) {
  Experiment all = experiment;
  if (all.tuning) all.worlds.insert(all.worlds.end(), all.tuning->worlds.begin(), all.tuning->worlds.end());
  return all;
}

}  // namespace

void check_graphs(const Experiment& checked, const BatchOptions& options, xml::Diagnostics& diagnostics,
                  const std::function<void(std::size_t done, std::size_t all)>& watch) {
  const bool is_whole = !diagnostics.has_errors();  // otherwise settings may be missing, of which it was said
  const Experiment experiment = is_whole ? checked : with_tuning_worlds(checked);
  const std::size_t all = experiment.worlds.size() * experiment.variants.size();
  host::PluginCatalogue catalogue(plugin::PluginIndex(options.plugin_folders), ClockKind::virtual_time);
  std::set<std::string> said;
  for (std::size_t world = 0; world < experiment.worlds.size(); ++world) {
    for (std::size_t variant = 0; variant < experiment.variants.size(); ++variant) {
      if (watch) watch(world * experiment.variants.size() + variant, all);
      catalogue.forget_graph();
      graph::LoadOptions load;
      load.profiles = experiment.variants[variant].profiles;
      const Run first{variant, world, experiment.seeds.front()};
      load.settings = experiment.settings_of(first);
      load.try_components = true;
      load.any_link = true;
      std::vector<graph::PlannedChange> changes;
      load.changes = &changes;
      xml::Diagnostics found;
      const auto graph = graph::load_file(experiment.variants[variant].graph, load, catalogue, found);
      if (graph) {
        refuse_unknown_failures(experiment.worlds[world], *graph, found);
        refuse_unknown_goals(experiment.goals_of(first), scene_at_start(*graph, catalogue), found);
      }
      refuse_changes(changes, found);
      for (const xml::Diagnostic& one : found.sorted()) {
        const bool follows = !is_whole && one.code == kArgumentWithoutValue;
        if (one.severity != xml::Severity::error || follows || !said.insert(one.text()).second) continue;
        diagnostics.error(one.code, one.position,
                          one.message + " (variant " + experiment.variants[variant].name + ", world " +
                              experiment.worlds[world].name + ")");
      }
    }
  }
}

}  // namespace orca::batch
