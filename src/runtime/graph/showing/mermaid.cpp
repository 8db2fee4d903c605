// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/graph/mermaid.hpp"
#include "drawing.hpp"

namespace orca::graph {
namespace {

// Quotes a text. Mermaid has entities of its own for characters that would end a text or start markup.
std::string quoted(const std::string& text) {
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

std::string node_text(const DrawnNode& node) {
  const std::string label = quoted(node.name + "\n" + node.type);
  std::string broken = label;
  broken.replace(broken.find('\n'), 1, "<br/>");
  return node.id + (node.hardware ? "[(" + broken + ")]" : "[" + broken + "]") + "\n";
}

}  // namespace

std::string mermaid(const Graph& graph, const std::string& profiles) {
  const Drawing drawing = drawing_of(graph, profiles);
  std::string text = "---\ntitle: " + drawing.title + "\n---\nflowchart LR\n";
  int boxes = 0;
  for (const auto& [context, nodes] : drawing.nodes) {
    const bool boxed = !context.empty();
    if (boxed) text += "  subgraph s" + std::to_string(boxes++) + "[" + quoted(context) + "]\n";
    for (const DrawnNode& node : nodes) text += (boxed ? "    " : "  ") + node_text(node);
    if (boxed) text += "  end\n";
  }
  for (const DrawnEdge& edge : drawing.edges) {
    text += "  " + edge.from + (edge.dashed ? " -. " : " -- ") + quoted(edge.label) +
            (edge.dashed ? " .-> " : " --> ") + edge.to + "\n";
  }
  return text;
}

}  // namespace orca::graph
