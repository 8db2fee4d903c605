// SPDX-License-Identifier: LGPL-3.0-or-later
#include "team.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "orca/base/text.hpp"
#include "reading/codes.hpp"
#include "reading/naming.hpp"
#include "reading/values.hpp"

namespace orca::graph {
namespace {

// Types of which components make a motion, or another task.
constexpr std::array<std::string_view, 9> kOrders{"ClientList",    "GoalPoint", "GripperCommand",
                                                  "MotionCommand", "Path",      "Route",
                                                  "TaskOrder",     "TripOrder", "TurretCommand"};

bool is_order(const TypeId& type) {
  const auto is = [](const TypeId& known) {
    return std::ranges::find(kOrders, std::string_view(known.name)) != kOrders.end();
  };
  return is(type) || std::ranges::any_of(type.ancestors, is);
}

std::string name_of_team_fault(std::string_view name) {
  if (name.find('/') != std::string_view::npos) return "it has no contexts, so no '/'";
  return name_fault(name).value_or("");
}

}  // namespace

Team read_team(const Node& root, Report& report) {
  Team team;
  team.name = root.value("join");
  if (!team.name.empty())
    if (const std::string fault = name_of_team_fault(team.name); !fault.empty())
      report.error(codes::kBadName, root.place("join"),
                   "join: the name " + in_quotes(team.name) + ": " + fault);
  const auto domain = read_attribute<std::int64_t>(root, "team_domain", report);
  team.domain = static_cast<std::uint32_t>(domain.value_or(0));
  team.interface = root.value("team_interface");
  return team;
}

std::string team_fault(std::string_view name, const PortContract& port) {
  if (std::string fault = name_of_team_fault(name); !fault.empty()) return fault;
  if (port.pattern != Pattern::push)
    return "only ports of Push speak to a team: no system gives orders to another one, or asks it";
  if (is_order(port.type))
    return "a " + port.type.name +
           " makes a robot do something, and no system of a team gives orders to another one";
  if (port.role == Role::proxy && !port.many)
    return "only a port array hears a team, because several systems may speak";
  return "";
}

std::vector<TeamPort> check_team(const Graph& graph, const xml::Position& join, const Model& model,
                                 Report& report) {
  if (graph.secured && !graph.team.name.empty())
    report.error(
        codes::kSecured, join,
        "the system joins the team " + in_quotes(graph.team.name) +
            ", in which all is plain, and the graph says security=\"on\"; remove join or security: the "
            "keys of a graph are known to its own processes only, so nobody in a team can prove who it is");
  std::map<std::string, std::pair<TeamPort, std::string>> known;  // with one port of each, for people
  for (const CheckedComponent& component : model.components) {
    for (const auto& [name, setting] : component.value.ports) {
      const std::string& alias = setting.alias.empty() ? name : setting.alias;
      const PortContract* const port = component.contract ? component.contract->port(alias) : nullptr;
      if (setting.team.empty() || port == nullptr) continue;
      const std::string path = component.value.name + "." + alias;
      const TeamPort here{setting.team, port->type.name, port->type.hash, port->role == Role::server};
      auto& [first, first_path] = known.try_emplace(setting.team, here, path).first->second;
      if (first.type != here.type || first.hash != here.hash)
        report.error(codes::kTeam, component.value.position,
                     in_quotes(path) + " is a port of " + here.type + " and " + in_quotes(first_path) +
                         " of " + first.type + ", and both are " + in_quotes(setting.team) +
                         " in the team; give one of them another name");
      first.offers = first.offers || here.offers;
    }
  }
  std::vector<TeamPort> ports;
  for (auto& [name, entry] : known) ports.push_back(std::move(entry.first));
  return ports;
}

}  // namespace orca::graph
