// SPDX-License-Identifier: LGPL-3.0-or-later
#include "checking/wiring.hpp"

#include "checking/trading/providers.hpp"
#include "endpoints.hpp"
#include "orca/base/text.hpp"
#include "ports.hpp"
#include "reading/codes.hpp"
#include "reading/naming.hpp"
#include "reading/trading/constraint.hpp"

namespace orca::graph {
namespace {

// Returns the only port of a candidate that fits; nothing after a report that there is none or more than one.
std::optional<std::string> fitting_port(const CheckedComponent& candidate, const PortContract& wanted,
                                        const std::string& title, const xml::Position& place,
                                        Report& report) {
  std::vector<std::string> fitting;
  for (const PortContract& port : candidate.contract->ports)
    if (fit_together(port, wanted)) fitting.push_back(candidate.value.name + "." + port.name);
  if (fitting.size() == 1) return fitting.front();
  const std::string name = in_quotes(candidate.value.name);
  const std::string reason = fitting.empty()
                                 ? " has no port that fits; " + name + " has " + ports_of(*candidate.contract)
                                 : " has several ports that fit, write one: " + listed(fitting);
  report.error(codes::kCandidate, place,
               title + " (" + described(wanted) + "): the candidate " + name + reason);
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<std::string>> candidate_names(const CheckedComponent& component,
                                                        const LateBinding& late, const Model& model,
                                                        Report& report) {
  if (!looks_like_constraint(late.candidates.value)) return split_names(late.candidates.value);
  const Wish wish{{component.value.name, late.port},
                  *component.contract->port(late.port),
                  "candidates",
                  late.candidates,
                  nullptr,
                  late.context};
  return find_providers(wish, model, report);
}

std::optional<Node> candidate_connection(const CheckedComponent& component, const LateBinding& late,
                                         const std::string& name, const Model& model, Report& report) {
  const xml::Position& place = late.candidates.position;
  std::string from = name;
  if (name.find('.') == std::string::npos) {
    const std::string title = component.value.name + "." + late.port;
    if (!check_component_exists(name, place, in_quotes(title) + ": candidates", model, report))
      return std::nullopt;
    const CheckedComponent& candidate = *model.component(name);
    if (!candidate.contract || !candidate.ports_known) return std::nullopt;
    const PortContract& wanted = *component.contract->port(late.port);
    const auto port = fitting_port(candidate, wanted, in_quotes(title), place, report);
    if (!port) return std::nullopt;
    from = *port;
  }
  Node connection{graph_rules().find("connect"), place, {}, {}};
  connection.attributes["from"] = {from, place, true, place.file};
  connection.attributes["to"] = {component.value.name + "." + late.port, place, true, place.file};
  return connection;
}

}  // namespace orca::graph
