// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <vector>

#include "checking/endpoints.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

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

}  // namespace orca::graph
