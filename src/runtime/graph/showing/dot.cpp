// SPDX-License-Identifier: LGPL-3.0-or-later
#include "drawing.hpp"
#include "orca/graph/print.hpp"

namespace orca::graph {
namespace {

std::string dot_string(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

// Returns the label. The line break is Graphviz's own escape, so it is added after quoting.
std::string label_of(const DrawnNode& node) {
  std::string name = dot_string(node.name);
  name.pop_back();
  return name + "\\n" + dot_string(node.type).substr(1);
}

std::string dot_node(const DrawnNode& node) {
  const char* shape = node.hardware ? ", shape=cylinder" : "";
  return node.id + " [label=" + label_of(node) + shape + "];";
}

std::string begin_cluster(int number, const std::string& title) {
  return "subgraph cluster_" + std::to_string(number) + " { label=" + dot_string(title) + ";";
}

}  // namespace

std::string dot(const Graph& graph, const std::string& profiles) {
  const Drawing drawing = drawing_of(graph, profiles);
  std::string text = "digraph " + dot_string(graph.name) + " {\n  label=" + dot_string(drawing.title) +
                     ";\n  rankdir=LR;\n  node [shape=box];\n";
  text += boxes_text(drawing, {begin_cluster, "}", dot_node});
  for (const DrawnEdge& edge : drawing.edges) {
    text += "  " + edge.from + " -> " + edge.to + " [label=" + dot_string(edge.label) +
            (edge.dashed ? ", style=dashed" : "") + "];\n";
  }
  return text + "}\n";
}

}  // namespace orca::graph
