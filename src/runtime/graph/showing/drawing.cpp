// SPDX-License-Identifier: LGPL-3.0-or-later
#include "drawing.hpp"

#include <utility>

#include "orca/graph/placement.hpp"

namespace orca::graph {
namespace {

std::string context_of(const std::string& name) {
  const std::size_t slash = name.rfind('/');
  return slash == std::string::npos ? "" : name.substr(0, slash);
}

std::string last_of(const std::string& name) { return name.substr(name.rfind('/') + 1); }

// Returns the label of an edge. Objects flow from a PushServer or a SendProxy; a Query goes to its server and
// comes back.
std::string label_of(const Edge& edge) {
  std::string label = edge.from.port + " > " + edge.to.port;
  if (edge.pattern == Pattern::push && edge.queue.depth > 1)
    label += " (" + std::to_string(edge.queue.depth) + ")";
  if (edge.pattern == Pattern::send) label += " (send)";
  if (edge.pattern == Pattern::query) label += " (query)";
  if (edge.late_bound) label += " (candidate)";
  if (edge.choice > 0) label += " (choice " + std::to_string(edge.choice) + ")";
  if (edge.link == Link::dds) label += " (dds)";
  return label;
}

std::string title_of(const ProcessNode& process) {
  return "process " + process.name + (process.machine.empty() ? "" : ", machine " + process.machine);
}

class Draughtsman {
 public:
  explicit Draughtsman(const Graph& graph) {
    const std::vector<ProcessNode> processes = processes_of(graph);
    for (const ProcessNode& process : processes) {
      boxes_[process.name] = drawing_.processes.size();
      drawing_.processes.push_back({processes.size() > 1 ? title_of(process) : "", {}});
    }
    for (const HardwareNode& node : graph.hardware) add(node);
    for (const ComponentNode& node : graph.components) add(node);
    for (const Edge& edge : graph.edges) add(edge);
  }

  Drawing drawing() && { return std::move(drawing_); }

 private:
  void add(const HardwareNode& node) {
    const std::string id = "h" + std::to_string(hardware_ids_.size());
    hardware_ids_[node.name] = id;
    box_of(node)[context_of(node.name)].push_back({id, last_of(node.name), node.type, true});
  }

  void add(const ComponentNode& node) {
    const std::string id = "c" + std::to_string(ids_.size());
    ids_[node.name] = id;
    box_of(node)[context_of(node.name)].push_back({id, last_of(node.name), node.type, false});
    if (!node.hardware.empty())
      drawing_.edges.push_back({hardware_ids_[node.hardware], id, "hardware", false});
  }

  void add(const Edge& edge) {
    drawing_.edges.push_back({ids_[edge.from.component], ids_[edge.to.component], label_of(edge),
                              edge.late_bound || edge.choice > 1});
  }

  template <class Part>
  std::map<std::string, std::vector<DrawnNode>>& box_of(const Part& part) {
    return drawing_.processes[boxes_.at(part.process)].nodes;
  }

  Drawing drawing_;
  std::map<std::string, std::size_t> boxes_;  // by process
  std::map<std::string, std::string> ids_;
  std::map<std::string, std::string> hardware_ids_;
};

// A writer of nested boxes.
class Boxes {
 public:
  explicit Boxes(const BoxWords& words) : words_(words) {}

  void write(const DrawnProcess& process) {
    open(process.title);
    for (const auto& [context, nodes] : process.nodes) {
      open(context);
      for (const DrawnNode& node : nodes) line(words_.node(node));
      close(context);
    }
    close(process.title);
  }

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  // Starts a box; none if it has no title.
  void open(const std::string& title) {
    if (title.empty()) return;
    line(words_.begin(count_++, title));
    ++depth_;
  }

  void close(const std::string& title) {
    if (title.empty()) return;
    --depth_;
    line(words_.end);
  }

  void line(const std::string& text) { text_ += std::string(2 * depth_, ' ') + text + "\n"; }

  const BoxWords& words_;
  std::string text_;
  std::size_t depth_ = 1;
  int count_ = 0;
};

}  // namespace

std::string boxes_text(const Drawing& drawing, const BoxWords& words) {
  Boxes boxes(words);
  for (const DrawnProcess& process : drawing.processes) boxes.write(process);
  return boxes.text();
}

Drawing drawing_of(const Graph& graph, const std::string& profiles) {
  Drawing drawing = Draughtsman(graph).drawing();
  drawing.title = graph.name + (profiles.empty() ? "" : ", profile " + profiles);
  return drawing;
}

}  // namespace orca::graph
