// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "orca/graph/graph.hpp"

namespace orca::graph {

// What a picture of a graph shows, whatever language it is written in.
struct DrawnNode {
  std::string id;    // "c3", "h0"
  std::string name;  // without its context
  std::string type;
  bool hardware = false;
};

struct DrawnEdge {
  std::string from;   // id
  std::string to;     // id
  std::string label;  // "OdometryPush > odometry"
  bool dashed = false;
};

struct Drawing {
  std::string title;
  std::map<std::string, std::vector<DrawnNode>> nodes;  // by context, "" first
  std::vector<DrawnEdge> edges;
};

Drawing drawing_of(const Graph& graph, const std::string& profiles);

}  // namespace orca::graph
