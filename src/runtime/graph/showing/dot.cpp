// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/graph/dot.hpp"
#include "drawing.hpp"

namespace orca::graph {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

// Returns the label. The line break is Graphviz's own escape, so it is added after quoting.
std::string label_of(const DrawnNode& node) {
  std::string name = quoted(node.name);
  name.pop_back();
  return name + "\\n" + quoted(node.type).substr(1);
}

std::string node_text(const DrawnNode& node) {
  const char* shape = node.hardware ? ", shape=cylinder" : "";
  return node.id + " [label=" + label_of(node) + shape + "];";
}

std::string begin_box(int number, const std::string& title) {
  return "subgraph cluster_" + std::to_string(number) + " { label=" + quoted(title) + ";";
}

}  // namespace

std::string dot(const Graph& graph, const std::string& profiles) {
  const Drawing drawing = drawing_of(graph, profiles);
  std::string text = "digraph " + quoted(graph.name) + " {\n  label=" + quoted(drawing.title) +
                     ";\n  rankdir=LR;\n  node [shape=box];\n";
  text += boxes_text(drawing, {begin_box, "}", node_text});
  for (const DrawnEdge& edge : drawing.edges) {
    text += "  " + edge.from + " -> " + edge.to + " [label=" + quoted(edge.label) +
            (edge.dashed ? ", style=dashed" : "") + "];\n";
  }
  return text + "}\n";
}

}  // namespace orca::graph
