// SPDX-License-Identifier: GPL-3.0-or-later
// Any files give a graph or errors. A graph that loads is the same after printing, and can be shown in every
// way.
//
// The input is the graph's file. After a line "%%file NAME" follows another file that it may include.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>

#include "fake_catalogue.hpp"
#include "orca/graph/diff.hpp"
#include "orca/graph/placement.hpp"
#include "orca/graph/port_list.hpp"
#include "orca/graph/print.hpp"

namespace {

using Files = std::map<std::string, std::string>;

constexpr std::string_view kMark = "\n%%file ";

// The files by path; the first is "/main.xml".
Files split(std::string_view input) {
  Files files;
  std::string name = "main.xml";
  for (;;) {
    const std::size_t end = input.find(kMark);
    files["/" + name] = std::string(input.substr(0, end));
    if (end == std::string_view::npos) return files;
    input.remove_prefix(end + kMark.size());
    const std::size_t line = std::min(input.find('\n'), input.size());
    name = std::string(input.substr(0, line));
    input.remove_prefix(line);
  }
}

// Checks that messages are valid text, and that none reports that Orca's two readers disagree.
void check_texts(const orca::xml::Diagnostics& diagnostics) {
  for (const orca::xml::Diagnostic& diagnostic : diagnostics.sorted()) {
    if (diagnostic.code == "G129") std::abort();
    orca::xml::Diagnostics complaints;
    static_cast<void>(
        orca::xml::read_text("<m t=\"" + orca::xml::escaped(diagnostic.message) + "\"/>", "m", complaints));
    if (complaints.has_errors()) std::abort();
  }
  if (diagnostics.json().empty()) std::abort();
}

std::optional<orca::graph::Graph> load(const Files& files, FakeCatalogue& catalogue, bool& errors) {
  orca::xml::Diagnostics diagnostics;
  const auto read = [&](const std::string& path) -> orca::Result<std::string> {
    const auto found = files.find(path);
    if (found == files.end()) return orca::fail(orca::Code::not_found, "No such file or directory");
    return found->second;
  };
  const orca::graph::LoadOptions options{.any_link = true};
  auto graph =
      orca::graph::load_text(files.at("/main.xml"), "/main.xml", options, catalogue, diagnostics, read);
  errors = diagnostics.has_errors();
  check_texts(diagnostics);
  return graph;
}

// Checks that each component is in one process and comes up once.
void check_placement(const orca::graph::Graph& graph) {
  std::size_t placed = 0;
  for (const orca::graph::ProcessNode& process : orca::graph::processes_of(graph))
    placed += orca::graph::part_of(graph, process.name).components.size();
  if (placed != graph.components.size()) std::abort();
  if (orca::graph::start_order(graph).size() != graph.components.size()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Files files = split(std::string_view(reinterpret_cast<const char*>(data), size));
  FakeCatalogue catalogue;
  bool errors = false;
  const auto graph = load(files, catalogue, errors);
  if (graph.has_value() == errors) std::abort();
  if (!graph) return 0;
  check_placement(*graph);
  const auto again = load({{"/main.xml", orca::graph::print(*graph)}}, catalogue, errors);
  if (!again || !(*again == *graph) || !orca::graph::diff(*graph, *again).empty()) std::abort();
  const bool shown = !orca::graph::dot(*graph, "").empty() && !orca::graph::mermaid(*graph, "").empty() &&
                     !orca::graph::graph_json(*graph).empty();
  if (!shown) std::abort();
  static_cast<void>(orca::graph::ports_text(orca::graph::list_ports(*graph, catalogue)));
  return 0;
}
