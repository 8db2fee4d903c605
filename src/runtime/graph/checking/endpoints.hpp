// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "model.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// One end of a connection, as far as it can be made out. `port` is null if it cannot, after a report or for a
// reason reported before.
struct Endpoint {
  PortRef ref;  // as far as known
  const PortContract* port = nullptr;
  std::optional<std::string> guessed;  // the port of `ref.component` that was probably meant
  // Another port that may be meant: the graph gives it the name of `port`, which it does not get.
  const PortContract* perhaps = nullptr;
};

Endpoint resolve_endpoint(const Node& connection, const char* attribute, const Model& model, Report& report);

// Objects leave through a PushServer, a QueryProxy and a SendProxy: `from` is one of them.
bool is_from_end(const PortContract& port);

// "the PushServer of RangeReadings \"base.laser\""
std::string described(const Endpoint& end);
// "PushServer of RangeReadings"
std::string described(const PortContract& port);

}  // namespace orca::graph
