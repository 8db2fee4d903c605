// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "model.hpp"
#include "orca/graph/port_list.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// One end of a connection, as far as it could be found. `port` is null if it could not, after a report or for
// a reason that is reported already.
struct Endpoint {
  PortRef ref;  // as far as known
  const PortContract* port = nullptr;
  std::optional<std::string> guessed;  // the port of `ref.component` that was probably meant
  // Another port that may be meant: the graph wanted to give it the name of `port` and could not.
  const PortContract* perhaps = nullptr;
};

Endpoint resolve_endpoint(const Node& connection, const char* attribute, const Model& model, Report& report);

// Reports a port that the command line wants to record if it is not there.
void check_recorded_port(const std::string& name, const Model& model, Report& report);

// Returns whether the port can be the `from` of a connection: a PushServer, a QueryProxy or a SendProxy.
bool is_from_end(const PortContract& port);

// Returns whether two ports can be connected, in one direction or the other: what one gives is, or derives from,
// what the other asks for. Replies are not looked at.
bool fit_together(const PortContract& a, const PortContract& b);

// Returns a text such as "the PushServer of RangeReadings \"base.laser\"".
std::string described(const Endpoint& end);

}  // namespace orca::graph
