// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "reading/assembly.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// The profiles that have a part of a kind ("component") and name.
using ProfilesByPart = std::map<std::pair<std::string, std::string>, std::set<std::string>>;

// The parts of a graph once its profiles are merged.
struct Parts {
  std::vector<Node> machines;
  std::vector<Node> processes;
  std::vector<Node> hardware;
  std::vector<Node> components;
  std::vector<Node> groups;
  std::vector<Node> connections;
  std::vector<Node> changes;
  ProfilesByPart left_out;    // of profiles that are not chosen
  bool some_missing = false;  // a file or a profile is missing, and parts of any kind may be in it
};

// Returns the graph's own parts with the chosen profiles merged over them in order.
// @param chosen  names from the command line; none: the graph's default_profile.
Parts merge_profiles(const Assembly& assembly, const std::vector<std::string>& chosen, Report& report);

}  // namespace orca::graph
