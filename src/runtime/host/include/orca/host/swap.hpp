// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/time.hpp"
#include "orca/plugin/image.hpp"
#include "orca/plugin/library.hpp"

namespace orca::host {

/// What is to take the place of a component or of a driver.
struct SwapOrder {
  std::string component;       ///< Its name in the graph, or that of the hardware.
  plugin::PluginImage plugin;  ///< The plugin with the new code.
  std::string type{};          ///< Its type there; empty: the one that the component has now.
  std::map<std::string, std::string>
      params{};  ///< New values, as written in a graph; others stay as they are.
  /// [s of the run's clock] time in which an exception or a failure of the new object brings the old one back.
  Duration probation{2s};
  /// Whether the plugin still is to be tried out in a copy of this process.
  plugin::Trial trial = plugin::Trial::now;
  bool fresh = false;  ///< The new object begins without the state of the old one, which is not asked for it.
  Duration open_limit{
      5s};  ///< [s of the run's clock] for a driver to open its device, and to start it if it is in use.
};

/// What has become of a swap that succeeded.
struct SwapReport {
  std::string old_type;
  std::string new_type;
  std::string build_id;                      ///< PluginLibrary::build_id() of the new code.
  std::vector<ParamContract> params;         ///< That the new code has.
  std::map<std::string, ParamValue> values;  ///< Of those that do not have their defaults.
  Duration pause{
      0};  ///< While neither object could work, of a component between two laps [s of the run's clock].
  std::string state;  ///< Tag of the state that the new object took over; empty: it began afresh.
};

}  // namespace orca::host
