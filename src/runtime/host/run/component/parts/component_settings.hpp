// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>

#include "orca/base/contract.hpp"
#include "orca/base/system/lap_time.hpp"
#include "orca/base/time.hpp"
#include "orca/host/kept_state.hpp"
#include "orca/host/planned_failure.hpp"
#include "orca/patterns/endpoints/cores.hpp"

namespace orca::host {

/// The settings that the graph gives one component.
struct ComponentSettings {
  std::string name;
  int priority = 0;
  std::optional<bool> autonomous;    ///< Replaces what the component says by stay_active().
  bool watchable = false;            ///< Works also while somebody looks at what it pushes.
  std::optional<Trigger> trigger;    ///< Replaces the author's trigger.
  LapTime takes{};                   ///< Virtual time that computing a lap takes.
  Cores* cores = nullptr;            ///< Those on which its laps compute with others; null: its own.
  bool on_demand = false;            ///< Loaded when first asked for.
  bool stay_warm = false;            ///< Stays in memory once it is loaded.
  Duration idle_time{0};             ///< An on-demand component that is not used for that long is unloaded.
  bool keeps_state = false;          ///< Its state is kept for the case that its process is lost.
  std::optional<KeptState> state;    ///< That it begins with, because its process was lost.
  std::vector<std::string> may_set;  ///< Parameters of others that it may set: "pilot.max_speed".
  std::vector<std::string> may_suspend;  ///< Other components that it may suspend.
  std::map<std::string, ParamValue> params;
  std::optional<PlannedFailure> failure;  ///< How it is made to fail.
  /// Names of ports in the graph, by the author's names.
  std::map<std::string, std::string> port_names;

  /// Returns the graph's name for a port, given the author's name.
  [[nodiscard]] const std::string& name_in_graph(const std::string& port) const {
    const auto renamed = port_names.find(port);
    return renamed == port_names.end() ? port : renamed->second;
  }
};

}  // namespace orca::host
