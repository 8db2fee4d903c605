// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "orca/host/component_state.hpp"

namespace orca::host {

/// What is known about a component of a run, in whatever process it lives. A plain value.
struct ComponentReport {
  ComponentState state = ComponentState::init;
  bool has_worked = false;   ///< It has been in WORK at some time.
  bool has_failed = false;   ///< It has been in WORK_FAILED at some time, or could not be configured.
  bool ended_badly = false;  ///< Its last work ended in WORK_FAILED.
  std::string failure;       ///< Why it has failed.

  friend bool operator==(const ComponentReport&, const ComponentReport&) = default;
};

/// A function that returns the report on a component of the graph.
using Reports = std::function<ComponentReport(const std::string& component)>;

}  // namespace orca::host
