// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
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

// The parts of one process, or of the whole graph if it has only one process.
struct DrawnProcess {
  std::string title;                                    // "process base, machine robot"; empty: no box
  std::map<std::string, std::vector<DrawnNode>> nodes;  // by context, "" first
};

// A picture of a graph before it is written in any language.
struct Drawing {
  std::string title;
  std::vector<DrawnProcess> processes;
  std::vector<DrawnEdge> edges;
};

// The words of a language for boxes and what is in them, one line each.
struct BoxWords {
  std::function<std::string(int number, const std::string& title)> begin;
  std::string end;
  std::function<std::string(const DrawnNode&)> node;
};

// Returns the nodes of a drawing: a box per process, and in it one per context.
std::string boxes_text(const Drawing& drawing, const BoxWords& words);

Drawing drawing_of(const Graph& graph, const std::string& profiles);

}  // namespace orca::graph
