// SPDX-License-Identifier: LGPL-3.0-or-later

// The steps of check_wiring(), each in a file of its own.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "checking/endpoints.hpp"
#include "checking/model.hpp"
#include "orca/graph/graph.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// Returns the edge between two existing ends if they fit together, with the queue and interval that the
// connection gives; nothing after a report.
std::optional<Edge> make_edge(const Node& connection, const Endpoint& from, const Endpoint& to,
                              Report& report);

// Returns the link that the connection names, else the one that suits the processes of its ends. Reports a link
// that cannot carry it.
Link link_of(const Node& connection, const Edge& edge, const Model& model, Report& report);

// Reports ports that push to more connections by DDS than one can serve.
void check_room_for_dds(const std::vector<Edge>& edges, Report& report);

// The connections of the proxies that take one at a time.
class Choices {
 public:
  explicit Choices(Report& report) : report_(report) {}

  // Adds a connection of a proxy. Returns false after a report that it cannot be added to those that are there.
  bool add(const Edge& edge, const Endpoint& proxy);

 private:
  bool add_to(const std::vector<Edge>& others, const Edge& edge, const Endpoint& proxy);
  bool refuse(const char* code, const Edge& edge, const Endpoint& proxy, const Edge& other,
              const std::string& what);

  Report& report_;
  std::map<PortRef, std::vector<Edge>> edges_;  // by proxy
};

// Returns the names of the candidates, of which some may be found by what they must be like; nothing after a report.
std::optional<std::vector<std::string>> candidate_names(const CheckedComponent& component,
                                                        const LateBinding& late, const Model& model,
                                                        Report& report);

// Returns the <connect> that a candidate stands for; nothing after a report. `name` is component.port, or a
// component alone if only one of its ports fits.
std::optional<Node> candidate_connection(const CheckedComponent& component, const LateBinding& late,
                                         const std::string& name, const Model& model, Report& report);

}  // namespace orca::graph
