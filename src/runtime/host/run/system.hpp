// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "component/component_instance.hpp"
#include "hardware_instance.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/hw/scene.hpp"
#include "orca/patterns/endpoints/links.hpp"
#include "run_context.hpp"

namespace orca::host {

/// The instances of one graph in this process and their wiring.
///
/// Thread contract: one thread, the executive's main task once it runs.
class System {
 public:
  /// @param give_up  asked while things come up: true to wait no longer.
  System(const graph::Graph& graph, RunContext& run, std::function<bool()> give_up)
      : graph_(graph), run_(run), give_up_(std::move(give_up)) {}

  /// Constructs hardware and components and connects them.
  /// @errors  of whatever cannot be constructed, with its name.
  Status build(PluginCatalogue& catalogue);

  /// Opens the hardware, then configures the components in the order of start_after. All must be up by the
  /// deadline.
  /// @errors  with the culprit's name and reason.
  Status bring_up(Event& changed, TimePoint deadline);

  /// Lets the components work.
  void open_gates();

  /// True when everything has let go of everything: components at rest, hardware idle.
  [[nodiscard]] bool at_rest() const;

  /// Stops the motors, ends all strands.
  /// @return the names of those that did not end in time, with what they are doing.
  std::vector<std::string> take_down(TimePoint deadline);

  /// Pauses a component between two laps, and lets it go on.
  /// @errors  not_found; failed_precondition if it cannot be suspended now; deadline_exceeded if a lap does
  /// not
  ///          end in time: it is carried out then when the lap does end.
  Status suspend(const std::string& component, Event& changed, TimePoint deadline);
  Status resume(const std::string& component, Event& changed, TimePoint deadline);

  /// Gives parameters new values, all together between two laps or none.
  /// @param texts  as a graph would say them, with units.
  /// @errors  not_found; invalid_argument with everything that is wrong; what the component itself says
  ///          against the values; deadline_exceeded as above.
  Status set_params(const std::string& component, const std::map<std::string, std::string>& texts,
                    Event& changed, TimePoint deadline);

  [[nodiscard]] const ComponentInstance* component(const std::string& name) const;
  [[nodiscard]] const std::vector<std::unique_ptr<ComponentInstance>>& components() const {
    return components_;
  }
  void draw(Scene& scene);

 private:
  Status build_hardware(PluginCatalogue& catalogue);
  Status build_components(PluginCatalogue& catalogue);
  Status declare(const graph::ComponentNode& node, ComponentInstance& instance, PluginCatalogue& catalogue);
  Status connect(Links& links);
  Status open_hardware(Event& changed, TimePoint deadline);
  Status configure(ComponentInstance& component, Event& changed, TimePoint deadline);
  Status carry_out(const std::string& name, Event& changed, TimePoint deadline,
                   const std::function<std::shared_ptr<Order>(ComponentInstance&)>& make);
  [[nodiscard]] Error no_such(const std::string& name) const;
  [[nodiscard]] ComponentInstance* find(const std::string& name) const;
  [[nodiscard]] hw::HardwareContainer* container(const std::string& name) const;
  [[nodiscard]] std::vector<ComponentInstance*> start_order() const;

  const graph::Graph& graph_;
  RunContext& run_;
  std::function<bool()> give_up_;
  std::vector<std::unique_ptr<HardwareInstance>> hardware_;
  std::vector<std::unique_ptr<ComponentInstance>>
      components_;  // in the order of the graph; gone before the hardware
};

}  // namespace orca::host
