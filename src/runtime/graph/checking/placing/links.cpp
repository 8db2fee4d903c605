// SPDX-License-Identifier: LGPL-3.0-or-later
#include "checking/wiring.hpp"

#include <array>
#include <map>
#include <string>

#include "orca/base/text.hpp"
#include "reading/codes.hpp"
#include "reading/values.hpp"

namespace orca::graph {
namespace {

// The process of one end of a connection.
struct End {
  const PortRef& port;
  const CheckedProcess& process;

  [[nodiscard]] std::string text() const {
    const std::string machine = process.value.machine;
    return in_quotes(port.text()) + " (process " + in_quotes(process.value.name) +
           (machine.empty() ? "" : ", machine " + in_quotes(machine)) + ")";
  }
};

// Returns the process of a component; null if it or its machine is not known, which is reported.
const CheckedProcess* process_of(const PortRef& port, const Model& model) {
  const CheckedComponent& component = *model.component(port.component);
  if (!component.process_known) return nullptr;
  const CheckedProcess* process = model.find_process(component.value.process);
  return process != nullptr && process->placed ? process : nullptr;
}

Link suitable(const End& from, const End& to) {
  if (&from.process == &to.process) return Link::local;
  return from.process.value.machine == to.process.value.machine ? Link::shm : Link::dds;
}

// Returns why the link cannot carry what a suitable link carries; empty: it can.
std::string misfit(Link link, Link best) {
  if (link == best || link == Link::dds) return {};
  if (link == Link::local) return "joins parts of one process";
  return best == Link::local ? "joins two processes" : "joins processes of one machine";
}

Link read_link(const Node& connection, Link best, Report& report) {
  const Text* text = connection.find("link");
  if (text == nullptr) return best;
  const auto name = read_value(*text, connection.rule->attribute("link")->value, "link", report);
  for (const Link link : {Link::local, Link::shm, Link::dds})
    if (name && std::get<std::string>(*name) == to_string(link)) return link;
  return best;
}

}  // namespace

Link link_of(const Node& connection, const Edge& edge, const Model& model, Report& report) {
  const CheckedProcess* const from_process = process_of(edge.from, model);
  const CheckedProcess* const to_process = process_of(edge.to, model);
  if (from_process == nullptr || to_process == nullptr) return Link::local;
  const End from{edge.from, *from_process};
  const End to{edge.to, *to_process};
  const Link best = suitable(from, to);
  const Link link = read_link(connection, best, report);
  const std::string ends = "cannot connect " + from.text() + " to " + to.text();
  const std::string reason = misfit(link, best);
  if (!reason.empty()) {
    report.error(codes::kLink, connection.place("link"),
                 ends + " by link=\"" + to_string(link) + "\", which " + reason +
                     "; remove link, or write link=\"" + to_string(best) + "\"");
  } else if (link == Link::dds && best == Link::local && !model.any_link) {
    report.error(
        codes::kLink, connection.place("link"),
        ends +
            " by link=\"dds\", which joins two processes; remove link, or put one of them into another "
            "process");
  }
  return link;
}

void check_room_for_dds(const std::vector<Edge>& edges, Report& report) {
  constexpr int kMost = 62;  // as patterns::dds: an object says for which of the port's connections it is
  std::map<PortRef, int> counts;
  for (const Edge& edge : edges) {
    if (edge.link != Link::dds || edge.pattern != Pattern::push || ++counts[edge.from] != kMost + 1) continue;
    report.error(
        codes::kLink, edge.position,
        "this is connection " + std::to_string(kMost + 1) + " of port " + in_quotes(edge.from.text()) +
            " by DDS, and a port serves " + std::to_string(kMost) +
            "; let some of its users share a component that passes it on, or leave out link=\"dds\"");
  }
}

}  // namespace orca::graph
