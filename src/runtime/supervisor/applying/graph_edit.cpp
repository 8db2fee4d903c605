// SPDX-License-Identifier: LGPL-3.0-or-later
#include "applying/graph_edit.hpp"

#include <algorithm>

#include "orca/base/text.hpp"
#include "orca/graph/plan.hpp"
#include "orca/graph/print.hpp"
#include "orca/xml/document.hpp"

namespace orca::supervisor {
namespace {

using graph::Edge;
using graph::PortRef;

// A component's name may hold no dot.
PortRef port_of(const std::string& path) {
  const std::size_t dot = path.find('.');
  return {path.substr(0, dot), dot == std::string::npos ? "" : path.substr(dot + 1)};
}

std::string attribute(const std::string& name, const std::string& value) {
  return " " + name + "=\"" + xml::escaped(value) + "\"";
}

}  // namespace

Result<std::string> with_connection(graph::Graph graph, const std::vector<std::string>& words) {
  Edge edge;
  edge.from = port_of(words.at(0));
  edge.to = port_of(words.at(1));
  std::string element = "<connect" + attribute("from", words[0]) + attribute("to", words[1]);
  for (std::size_t i = 2; i < words.size(); ++i) {
    const std::size_t sign = words[i].find('=');
    if (sign == std::string::npos || sign == 0)
      return fail(Code::invalid_argument,
                  in_quotes(words[i]) + " is no ATTRIBUTE=VALUE of a connection, such as queue=10");
    element += attribute(words[i].substr(0, sign), words[i].substr(sign + 1));
  }
  graph::put(edge, false, graph.edges);
  std::string text = graph::print(graph);
  return text.insert(text.rfind("</"), element + "/>\n");
}

Result<std::string> without_connection(graph::Graph graph, const std::string& from, const std::string& to) {
  Edge edge;
  edge.from = port_of(from);
  edge.to = port_of(to);
  const std::size_t before = graph.edges.size();
  graph::put(edge, false, graph.edges);
  if (graph.edges.size() == before)
    return fail(Code::not_found, "there is no connection from " + from + " to " + to);
  return graph::print(graph);
}

Result<std::string> with_other_server(graph::Graph graph, const std::string& client,
                                      const std::string& server) {
  const PortRef port = port_of(client);
  const auto uses = [&](const Edge& edge) { return edge.client() == port; };
  const auto found = std::ranges::find_if(graph.edges, uses);
  if (std::ranges::any_of(graph.edges, [&](const Edge& edge) { return edge.server() == port; }))
    return fail(Code::invalid_argument,
                client + " serves others; name the port that is to use another server");
  if (found == graph.edges.end())
    return fail(Code::not_found, client + " has no connection; orcactl connect makes one");
  if (std::ranges::count_if(graph.edges, uses) > 1)
    return fail(Code::failed_precondition, client +
                                               " has several connections; use orcactl connect and disconnect "
                                               "to say which one is meant");
  (found->pattern == Pattern::push ? found->from : found->to) = port_of(server);
  const graph::ComponentNode* const there = graph.find_component(found->server().component);
  if (there == nullptr) return fail(Code::invalid_argument, "there is no component of the port " + server);
  const bool is_within = there->process == graph.find_component(port.component)->process;
  if (found->link != graph::Link::dds) found->link = is_within ? graph::Link::local : graph::Link::shm;
  return graph::print(graph);
}

}  // namespace orca::supervisor
