// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "orca/graph/graph.hpp"

namespace orca::graph {

// One box of a picture of a graph, in whatever language the picture is written.
struct DrawnNode {
  std::string id;    // "c3", "h0"
  std::string name;  // without its context
  std::string type;
  bool hardware = false;
};

// One arrow of such a picture.
struct DrawnEdge {
  std::string from;   // id
  std::string to;     // id
  std::string label;  // "OdometryPush > odometry"
  bool dashed = false;
};

// A picture of a graph before it is written in any language.
struct Drawing {
  std::string title;
  std::map<std::string, std::vector<DrawnNode>> nodes;  // by context, "" first
  std::vector<DrawnEdge> edges;
};

Drawing drawing_of(const Graph& graph, const std::string& profiles);

}  // namespace orca::graph
