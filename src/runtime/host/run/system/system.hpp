// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "component_list.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/host/run_result.hpp"
#include "orca/host/run_view.hpp"
#include "orca/hw/scene.hpp"
#include "run/hardware/hardware_place.hpp"
#include "run/reporting/run_context.hpp"
#include "topics.hpp"

namespace orca::host {

/// Hardware that may move something: all of it, or what is on a line to a device.
enum class Movers { all, on_lines };

/// The instances of one graph in this process and their wiring.
///
/// Thread contract: one thread, the executive's main task once it runs.
class System {
 public:
  /// @param give_up  called while the system comes up, or an order waits for the end of a lap; true ends the waiting.
  System(const graph::Graph& graph, RunContext& run, std::function<bool()> give_up)
      : graph_(graph), run_(run), give_up_(std::move(give_up)), topics_(graph, run.run) {}

  /// Constructs hardware and components and connects them.
  /// @errors  the error of whatever cannot be constructed, with its name.
  Status build(PluginCatalogue& catalogue);

  /// Opens the hardware, then configures the components in the order of start_after. All must be up by the
  /// deadline.
  /// @errors  with the culprit's name and reason.
  Status bring_up(Event& changed, TimePoint deadline);

  /// Opens the hardware.
  /// @errors  as bring_up().
  Status open_hardware(Event& changed, TimePoint deadline);
  /// Configures a component.
  /// @errors  as bring_up(); not_found.
  Status configure(const std::string& component, Event& changed, TimePoint deadline);

  /// Lets the components work.
  void open_gates();

  /// Returns whether nothing is in use any more: components are at rest, hardware is idle.
  [[nodiscard]] bool at_rest() const;

  /// Checks that no component is in use: none has a client, and nothing that was sent or asked is left.
  /// @errors  failed_precondition with the name of one that is.
  [[nodiscard]] Status check_unused() const;

  /// Stops the motors and ends all strands.
  /// @param keeps_states  whether the components' states are handed out, whatever the graph says.
  /// @return the names of those that did not end in time, with what they are doing.
  std::vector<std::string> take_down(TimePoint deadline, bool keeps_states = false);

  /// Stops the motors and closes the hardware, however the rest is doing.
  /// @param limit  [s of the steady clock] time to wait for it.
  /// @thread  any, while the strands run.
  void stop_hardware(Duration limit);

  /// Stops what moves and refuses commands to move, until let_go().
  /// @thread  any, once the system is built.
  /// @return whether there is any such hardware.
  bool hold(const std::string& reason, Movers what);
  /// Returns whether anything was held.
  bool let_go();

  /// Pause a component between two laps, and resume it.
  /// @errors  not_found; failed_precondition if it cannot be suspended now, or the system is given up meanwhile;
  ///          deadline_exceeded if a lap does not end in time. The order is then carried out when the lap does end.
  Status suspend(const std::string& component, Event& changed, TimePoint deadline);
  Status resume(const std::string& component, Event& changed, TimePoint deadline);

  /// Gives parameters new values between two laps, all together or none.
  /// @param texts  values as written in a graph, with units.
  /// @errors  not_found; invalid_argument with everything that is wrong; the component's own objection to the
  ///          values; deadline_exceeded as above.
  Status set_params(const std::string& component, const std::map<std::string, std::string>& texts,
                    Event& changed, TimePoint deadline);

  /// Constructs one more component, unconnected.
  /// @param node  its hardware is in this process.
  /// @errors  as build(); already_exists.
  Status add(const graph::ComponentNode& node, PluginCatalogue& catalogue);
  /// Ends a component that nobody is connected to.
  /// @return what is left of it, without a strand.
  /// @errors  not_found; deadline_exceeded with what it is doing. It may end later all the same.
  Result<std::unique_ptr<ComponentInstance>> remove(const std::string& component, TimePoint deadline);

  /// Calls a function that changes connections of a component, on its strand between two laps, or at once before it is
  /// configured. If that is not possible by the deadline, the function is never called.
  /// @errors  not_found; the function's own; deadline_exceeded; failed_precondition if the system is given up meanwhile.
  Status on_strand(const std::string& component, Event& changed, TimePoint deadline,
                   std::function<Status()> rewire);

  /// Returns the endpoint of a port; null if there is none.
  [[nodiscard]] Endpoint* endpoint(const graph::PortRef& port) const;
  [[nodiscard]] const ComponentInstance* component(const std::string& name) const;
  /// Returns a component, to change it.
  /// @errors  not_found with the names that there are.
  [[nodiscard]] Result<ComponentInstance*> instance(const std::string& name) const;
  [[nodiscard]] const ComponentList& components() const { return components_; }
  /// Returns the place of a hardware element of the graph, to change it; null: it is not in this process.
  [[nodiscard]] HardwarePlace* hardware(const std::string& name) const;
  /// Returns the names of the robots, by their hardware.
  /// @pre  build() has succeeded.
  [[nodiscard]] std::map<std::string, std::string> robots() const;
  /// Returns components and hardware that do not work as they should, or not yet.
  /// @thread  any, once the system is built.
  [[nodiscard]] std::vector<RunGlance::Unwell> unwell() const;
  void draw(Scene& scene);

 private:
  Status build_hardware(PluginCatalogue& catalogue);
  Status build_components(PluginCatalogue& catalogue);
  Result<std::unique_ptr<ComponentInstance>> make(const graph::ComponentNode& node,
                                                  ComponentSettings settings, PluginCatalogue& catalogue);
  Status await(const ComponentInstance& component, Order& order, Event& changed, TimePoint deadline);

  const graph::Graph& graph_;
  RunContext& run_;
  std::function<bool()> give_up_;
  std::vector<std::unique_ptr<HardwarePlace>> hardware_;
  std::set<std::string> fresh_;  // components that were added and not configured yet
  Topics topics_;                // outlives the ports
  ComponentList components_;     // in the order of the graph at first; destroyed before the hardware
};

/// Collects the counters of all connections that end in this process: of each edge at its receiving end, of each port that
/// sends, asks or serves. And those of its components whose laps take virtual time.
/// @param graph  of the whole system, of which this process may run a part.
/// @thread  any.
[[nodiscard]] RunCounters collect_counters(const graph::Graph& graph, const System& system);

}  // namespace orca::host
