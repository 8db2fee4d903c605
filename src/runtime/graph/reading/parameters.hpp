// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <set>
#include <string>

#include "node.hpp"
#include "orca/base/contract.hpp"
#include "orca/graph/graph.hpp"
#include "report.hpp"

namespace orca::graph {

// All parameters of a hardware or component node.
struct ReadParams {
  Params here;                   // defaults that are files of the current folder
  Params values;                 // those that the node sets, and defaults for the rest
  std::set<std::string> unread;  // parameters that have their default because an error is reported instead

  [[nodiscard]] bool sound() const { return unread.empty(); }
};

// Reads the parameters that the node sets. A misspelt name may stand for any parameter that the node does not
// set, so all of these count as unread then.
ReadParams read_params(const Node& node, const Contract& contract, Report& report);

// Returns the place that sets the parameter, or the node's own place if nothing sets it.
[[nodiscard]] const xml::Position& place_of_param(const Node& node, const std::string& param);

}  // namespace orca::graph
