// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/graph/port_list.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "checking/endpoints.hpp"
#include "orca/base/json.hpp"

namespace orca::graph {
namespace {

Result<Contract> contract_of(const ComponentNode& node, const Graph& graph, Catalogue& catalogue) {
  const HardwareNode* hardware = graph.find_hardware(node.hardware);
  if (hardware == nullptr) return catalogue.component(node.type, nullptr);
  const HardwareUse use{hardware->name, hardware->type, hardware->params};
  return catalogue.component(node.type, &use);
}

ListedPort listed(const ComponentNode& node, const PortContract& contract) {
  ListedPort port{{node.name, contract.name}, contract, false, {}, {}, node.process};
  const auto found = node.ports.find(contract.name);
  if (found == node.ports.end()) return port;
  if (!found->second.alias.empty()) port.ref.port = found->second.alias;
  port.disabled = found->second.disabled;
  port.candidates = found->second.candidates;
  port.topic = found->second.topic;
  port.team = found->second.team;
  return port;
}

std::string name(const PortRef& ref) { return ref.text(); }
std::string name(const ListedPeer& peer) {
  std::string how = peer.choice == 0 ? "" : "choice " + std::to_string(peer.choice);
  if (peer.in_use) how += ", in use";
  if (peer.link != Link::local) how += (how.empty() ? "" : ", ") + std::string(to_string(peer.link));
  return peer.ref.text() + (how.empty() ? "" : " (" + how + ")");
}

template <class Named>
std::string names(const std::vector<Named>& ports) {
  std::string text;
  for (const Named& port : ports) text += (text.empty() ? "" : ", ") + name(port);
  return text;
}

std::string connection_text(const ListedPort& port) {
  std::string text;
  if (port.disabled) return "disabled";
  if (!port.peers.empty()) text = (is_from_end(port.contract) ? "to " : "from ") + names(port.peers);
  if (!port.candidates.empty())
    text += (text.empty() ? "one of " : "; one of ") + names(port.candidates) + ", named at run time";
  if (!port.topic.empty()) text += (text.empty() ? "topic " : "; topic ") + port.topic;
  if (!port.team.empty()) text += (text.empty() ? "team: " : "; team: ") + port.team;
  return text.empty() ? "not connected" : text;
}

using Row = std::array<std::string, 4>;

Row row_of(const ListedPort& port) {
  const PortContract& contract = port.contract;
  const std::string type = contract.type.name + (contract.reply ? " -> " + contract.reply->name : "");
  return {port.ref.text() + (contract.many ? "[]" : ""),
          std::string(to_string(contract.pattern)) + to_string(contract.role), type, connection_text(port)};
}

std::vector<std::string> texts(const std::vector<PortRef>& refs) {
  std::vector<std::string> result;
  for (const PortRef& ref : refs) result.push_back(ref.text());
  return result;
}

template <class Value>
void write_values(const char* key, const std::vector<Value>& values, JsonWriter& json) {
  json.key(key).begin_array();
  for (const Value value : values) json.value(value);
  json.end();
}

void write(const ListedPort& port, JsonWriter& json) {
  json.begin_object();
  std::vector<PortRef> peers;
  std::vector<std::string> links;
  std::vector<std::int64_t> choices;
  std::vector<bool> in_use;
  for (const ListedPeer& peer : port.peers) {
    peers.push_back(peer.ref);
    links.emplace_back(to_string(peer.link));
    choices.push_back(peer.choice);
    in_use.push_back(peer.in_use);
  }
  json.member("port", port.ref.text());
  json.member("declared_as", port.contract.name);
  json.member("process", port.process);
  json.member("pattern", to_string(port.contract.pattern));
  json.member("role", to_string(port.contract.role));
  json.member("type", port.contract.type.name);
  if (port.contract.reply) json.member("reply", port.contract.reply->name);
  json.member("required", port.contract.required);
  json.member("many", port.contract.many);
  json.member("disabled", port.disabled);
  json.member("connected_to", texts(peers));
  json.member("links", links);
  write_values("choices", choices, json);
  write_values("in_use", in_use, json);
  json.member("candidates", texts(port.candidates));
  if (!port.topic.empty()) json.member("topic", port.topic);
  if (!port.team.empty()) json.member("team", port.team);
  json.member("text", port.contract.text);
  json.end();
}

}  // namespace

std::string described(const PortContract& port) {
  const std::string what =
      std::string(to_string(port.pattern)) + to_string(port.role) + " of " + port.type.name;
  return port.reply ? what + " answered by " + port.reply->name : what;
}

std::vector<ListedPort> list_ports(const Graph& graph, Catalogue& catalogue) {
  std::map<PortRef, std::vector<ListedPeer>> peers;
  for (const Edge& edge : graph.edges) {
    peers[edge.from].push_back({edge.to, edge.link, edge.choice});
    if (!edge.late_bound) peers[edge.to].push_back({edge.from, edge.link, edge.choice});
  }
  std::vector<ListedPort> ports;
  for (const ComponentNode& node : graph.components) {
    const Result<Contract> contract = contract_of(node, graph, catalogue);
    if (!contract) continue;  // the contract existed when the graph was checked
    for (const PortContract& declared : contract->ports) {
      ports.push_back(listed(node, declared));
      ports.back().peers = peers[ports.back().ref];
    }
  }
  return ports;
}

void mark_in_use(std::vector<ListedPort>& ports, const std::vector<const Edge*>& edges) {
  for (ListedPort& port : ports)
    for (ListedPeer& peer : port.peers)
      peer.in_use = std::ranges::any_of(edges, [&](const Edge* edge) {
        return (edge->from == port.ref && edge->to == peer.ref) ||
               (edge->to == port.ref && edge->from == peer.ref);
      });
}

std::string ports_text(const std::vector<ListedPort>& ports) {
  std::array<std::size_t, 3> widths{};
  std::vector<Row> rows;
  for (const ListedPort& port : ports) rows.push_back(row_of(port));
  for (const Row& row : rows)
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  std::string text;
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < widths.size(); ++i)
      text += row[i] + std::string(widths[i] - row[i].size() + 2, ' ');
    text += row.back() + "\n";
  }
  return text;
}

std::string ports_json(const std::vector<ListedPort>& ports) {
  JsonWriter json;
  json.begin_array();
  for (const ListedPort& port : ports) write(port, json);
  json.end();
  return json.text();
}

}  // namespace orca::graph
