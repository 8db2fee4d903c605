// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <span>
#include <string>

#include "orca/base/contract.hpp"
#include "orca/graph/graph.hpp"
#include "orca/xml/schema.hpp"

namespace orca::graph {

/// Returns the graph as XML again, with profiles merged, arguments replaced, defaults filled in and values in
/// SI. Loading that text gives an equal Graph.
[[nodiscard]] std::string print(const Graph& graph);

/// Returns the value of a parameter as print() writes it.
[[nodiscard]] std::string print_value(const ParamValue& value);

/// Does the same for all values of some parameters, by name.
[[nodiscard]] std::map<std::string, std::string> print_values(const Params& params);

/// The graph as JSON, for programs: an object with machines, processes, hardware, components, groups and connections;
/// attributes as in XML, parameters as numbers, flags and texts, in SI.
[[nodiscard]] std::string graph_json(const Graph& graph);

/// Returns the graph as a picture for Graphviz (`deployer GRAPH --dot | dot -Tsvg`): components and hardware
/// with their types, connections with their ports, processes and sub-graphs as boxes, late-bound edges dashed.
///
/// @param profiles  the profiles merged into it, for the title; may be empty.
[[nodiscard]] std::string dot(const Graph& graph, const std::string& profiles);

/// Returns the graph as a Mermaid flow chart, which many web pages and editors draw. Shows what dot() shows.
///
/// @param profiles  the profiles merged into it, for the title; may be empty.
[[nodiscard]] std::string mermaid(const Graph& graph, const std::string& profiles);

/// Returns the graph's language as an XML schema, for editors: graphs/orca-graph.xsd, or .rnc. It is made from the
/// rules that the reader follows, but is less strict than the reader: any value may be "${arg}", and a parameter
/// may have any value and be one of any of the types.
///
/// @param types  components and hardware that may be used, whose ports and parameters it describes; empty: any.
[[nodiscard]] std::string schema(std::span<const Contract> types,
                                 xml::SchemaLanguage language = xml::SchemaLanguage::xsd);

}  // namespace orca::graph
