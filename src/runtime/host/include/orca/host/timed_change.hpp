// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>

#include "orca/base/time.hpp"
#include "orca/graph/plan.hpp"

namespace orca::host {

/// What becomes of a system in the middle of its run, at a time known before: it goes over to another graph.
struct TimedChange {
  std::string file;                            ///< Of the other graph, for people.
  Duration at{0};                              ///< [s of the run's clock] since everything was up.
  graph::GraphPlan plan;                       ///< From the graph before to this one. It is possible.
  std::map<std::string, std::string> plugins;  ///< The file of each type that the plan puts in place.
};

}  // namespace orca::host
