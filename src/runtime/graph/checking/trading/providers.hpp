// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "checking/model.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// What a port seeks among the components of a graph.
struct Wish {
  PortRef client;
  const PortContract& wanted;  // of the client's port
  const char* attribute;       // that has the constraint, for messages
  const Text& constraint;
  const Text* prefer = nullptr;  // null: the order of the file counts
  std::string context{};         // of the file that seeks: it finds only what is in this context
};

// Returns the ports that fit, as component.port, the preferred one first. Returns nothing after a report, or if it cannot
// be known for a reason that is reported already.
std::optional<std::vector<std::string>> find_providers(const Wish& wish, const Model& model, Report& report);

}  // namespace orca::graph
