// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "reading/assembly.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// The parts of a graph once its profiles are merged.
struct Parts {
  std::vector<Node> machines;
  std::vector<Node> processes;
  std::vector<Node> hardware;
  std::vector<Node> components;
  std::vector<Node> groups;
  std::vector<Node> connections;
  std::vector<Node> changes;
  bool some_missing = false;  // a file or a profile is missing, and parts of any kind may be in it
};

// Returns the graph's own parts with the chosen profiles merged over them in order.
// @param chosen  names from the command line; none: the graph's default_profile.
Parts merge_profiles(const Assembly& assembly, const std::vector<std::string>& chosen, Report& report);

}  // namespace orca::graph
