// SPDX-License-Identifier: LGPL-3.0-or-later
#include "drawing.hpp"
#include "orca/graph/print.hpp"

namespace orca::graph {
namespace {

// Quotes a text. Mermaid has entities of its own for characters that would end a text or start markup.
std::string mermaid_string(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    switch (c) {
      case '"': result += "#quot;"; break;
      case '<': result += "#lt;"; break;
      case '>': result += "#gt;"; break;
      case '#': result += "#35;"; break;
      default: result += c;
    }
  }
  return result + "\"";
}

std::string mermaid_node(const DrawnNode& node) {
  const std::string label = mermaid_string(node.name + "\n" + node.type);
  std::string broken = label;
  broken.replace(broken.find('\n'), 1, "<br/>");
  return node.id + (node.hardware ? "[(" + broken + ")]" : "[" + broken + "]");
}

std::string begin_subgraph(int number, const std::string& title) {
  return "subgraph s" + std::to_string(number) + "[" + mermaid_string(title) + "]";
}

}  // namespace

std::string mermaid(const Graph& graph, const std::string& profiles) {
  const Drawing drawing = drawing_of(graph, profiles);
  std::string text = "---\ntitle: " + drawing.title + "\n---\nflowchart LR\n";
  text += boxes_text(drawing, {begin_subgraph, "end", mermaid_node});
  for (const DrawnEdge& edge : drawing.edges) {
    text += "  " + edge.from + (edge.dashed ? " -. " : " -- ") + mermaid_string(edge.label) +
            (edge.dashed ? " .-> " : " --> ") + edge.to + "\n";
  }
  return text;
}

}  // namespace orca::graph
