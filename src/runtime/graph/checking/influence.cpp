// SPDX-License-Identifier: LGPL-3.0-or-later
#include "checking/checks.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "orca/base/text.hpp"
#include "reading/codes.hpp"

namespace orca::graph {
namespace {

using Names = std::set<std::string>;

bool is_output(const PortContract& port) {
  return port.pattern == Pattern::push && port.role == Role::server;
}

bool asks(const PortContract& port) { return port.pattern == Pattern::query && port.role == Role::proxy; }

bool sends(const PortContract& port) { return port.pattern == Pattern::send && port.role == Role::proxy; }

class Influence {
 public:
  Influence(const Model& model, const Graph& graph, Report& report)
      : model_(model), graph_(graph), report_(report) {
    for (const Edge& edge : graph.edges) {
      connected_[edge.from.component].insert(edge.from.port);
      connected_[edge.to.component].insert(edge.to.port);
      const bool push = edge.pattern == Pattern::push;
      const std::string& user = push ? edge.to.component : edge.from.component;
      const std::string& provider = push ? edge.from.component : edge.to.component;
      providers_[user].insert(provider);
      used_.insert(provider);
    }
    // Whoever reads a topic, or is in the team, makes its component work.
    for (const CheckedComponent& component : model.components)
      for (const auto& [name, setting] : component.value.ports)
        if (setting.speaks_outside())
          connected_[component.value.name].insert(setting.alias.empty() ? name : setting.alias);
    find_idle();
  }

  void check() {
    Names bound;
    for (const CheckedComponent& component : model_.components) bound.insert(component.value.hardware);
    for (const CheckedHardware& hardware : model_.hardware) {
      if (bound.contains(hardware.value.name) || offers_lines(hardware.value)) continue;
      report_.warning(codes::kUnusedHardware, hardware.value.position,
                      "hardware " + in_quotes(hardware.value.name) +
                          ": no component is bound to it, so nothing comes of it");
    }
    for (const CheckedComponent& component : model_.components) check(component);
    for (const CheckedComponent& component : model_.components) check_circle(component);
  }

 private:
  void check(const CheckedComponent& component) {
    if (component.contract->ports.empty()) return;
    const Names& connected = connected_[component.value.name];
    if (!connected.empty()) check_arrays(component, connected);
    if (works_by_itself(component.value)) return;
    if (connected.empty()) return warn(codes::kNoInfluence, component, "it is connected to nothing");
    if (idle_.contains(component.value.name) && !used_.contains(component.value.name))
      return warn_end(component, connected);
    check_trigger(component, connected);
  }

  [[nodiscard]] bool works_by_itself(const ComponentNode& node) const {
    const auto speaks = [](const auto& port) { return port.second.speaks_outside(); };
    return node.autonomous.value_or(false) || node.watchable || std::ranges::any_of(node.ports, speaks) ||
           std::ranges::find(graph_.ends, node.name) != graph_.ends.end();
  }

  // --- Components that never work -------------------------------------------------------------------------

  // Returns whether a component can work only while another one uses it, as far as its ports tell. One that sends
  // may have a reason of its own, and so must one without outputs, unless it asks: it could never work otherwise.
  [[nodiscard]] bool depends_on_users(const CheckedComponent& component) {
    if (works_by_itself(component.value)) return false;
    const Names& connected = connected_[component.value.name];
    const auto any = [&](bool (*is_it)(const PortContract&), bool only_connected) {
      return std::ranges::any_of(component.contract->ports, [&](const PortContract& port) {
        return is_it(port) && (!only_connected || connected.contains(port.name));
      });
    };
    const bool starts_itself = any(sends, true) && component.value.autonomous.value_or(true);
    return !connected.empty() && !starts_itself && (any(is_output, false) || any(asks, true));
  }

  // Finds the components that nobody uses who works.
  void find_idle() {
    std::vector<std::string> working;
    for (const CheckedComponent& component : model_.components) {
      if (!depends_on_users(component)) {
        working.push_back(component.value.name);
      } else {
        idle_.insert(component.value.name);
      }
    }
    while (!working.empty()) {
      const std::string user = std::move(working.back());
      working.pop_back();
      for (const std::string& provider : providers_[user])
        if (idle_.erase(provider) > 0) working.push_back(provider);
    }
  }

  // Notes a component as told, and returns those that it uses, directly or through others, and that are not told
  // yet: they are idle like it.
  std::vector<std::string> tell(const std::string& idle) {
    std::vector<std::string> providers;
    told_.insert(idle);
    std::vector<std::string> users{idle};
    while (!users.empty()) {
      const std::string user = std::move(users.back());
      users.pop_back();
      for (const std::string& provider : providers_[user]) {
        if (!idle_.contains(provider) || !told_.insert(provider).second) continue;
        users.push_back(provider);
        providers.push_back(provider);
      }
    }
    return providers;
  }

  // Warns about the end of a chain that nobody uses.
  void warn_end(const CheckedComponent& component, const Names& connected) {
    std::vector<std::string> unused;
    bool asking = false;
    for (const PortContract& port : component.contract->ports) {
      if (is_output(port)) unused.push_back(port.name);
      asking = asking || (asks(port) && connected.contains(port.name));
    }
    std::string reason = asking ? "it asks others, but nothing makes it work: " : "";
    reason += unused.empty() ? "it has no output that others could use"
                             : "nobody listens to what it pushes: " + listed(unused);
    const std::vector<std::string> providers = tell(component.value.name);
    if (!providers.empty()) reason += "; and what only it uses never works either: " + listed(providers);
    warn(asking ? codes::kOnlyAsks : codes::kNoInfluence, component, reason);
  }

  // Warns about components that only use each other.
  void check_circle(const CheckedComponent& component) {
    const std::string& name = component.value.name;
    if (!idle_.contains(name) || told_.contains(name)) return;
    std::vector<std::string> circle = tell(name);
    circle.insert(circle.begin(), name);
    warn(codes::kCircle, component,
         "these only use each other, so none of them begins to work: " + listed(circle));
  }

  void warn(const char* code, const CheckedComponent& component, const std::string& reason) {
    report_.warning(code, component.value.position,
                    "component " + in_quotes(component.value.name) + ": " + reason +
                        "; if it works all the same, say so with autonomous=\"true\"");
  }

  // --- Ports that get nothing -----------------------------------------------------------------------------

  // An array may be empty where the component listens to something else, too.
  void check_arrays(const CheckedComponent& component, const Names& connected) {
    const auto is_heard = [](const PortContract& port) {
      return port.pattern == Pattern::push && port.role == Role::proxy;
    };
    const std::vector<PortContract>& ports = component.contract->ports;
    if (std::ranges::any_of(
            ports, [&](const PortContract& port) { return is_heard(port) && connected.contains(port.name); }))
      return;
    for (const PortContract& port : ports) {
      if (!port.many || !is_heard(port)) continue;
      report_.warning(codes::kNothingToCollect, component.value.position,
                      "component " + in_quotes(component.value.name) + ": its port " + in_quotes(port.name) +
                          " collects " + port.type.name +
                          " from any number of components, and none is connected; " +
                          "connect some, or say that it is not used: <port name=" +
                          in_quotes(authors_name(component, port.name)) + " disabled=\"true\"/>");
    }
  }

  void check_trigger(const CheckedComponent& component, const Names& connected) {
    const Trigger& trigger = component.value.trigger.value_or(component.contract->default_trigger);
    if (!trigger.waits_for_ports() || trigger.period > Duration{0}) return;
    std::vector<std::string> silent;
    for (const std::string& name : trigger.ports)
      if (const std::string port = name_in_graph(component, name); !connected.contains(port))
        silent.push_back(in_quotes(port));
    if (silent.empty() || (!trigger.needs_all_ports() && silent.size() < trigger.ports.size())) return;
    report_.warning(codes::kNeverTriggered, component.value.position,
                    "component " + in_quotes(component.value.name) + ": its laps start on port " +
                        listed(silent) + ", to which nothing is connected, so it never does one; " +
                        "connect it, or set period or on");
  }

  // Returns the graph's name of a port; the author's own trigger uses the author's name.
  static std::string name_in_graph(const CheckedComponent& component, const std::string& port) {
    const auto renamed = component.renamed.find(port);
    return renamed == component.renamed.end() ? port : renamed->second.name;
  }

  static std::string authors_name(const CheckedComponent& component, const std::string& port) {
    for (const auto& [name, renaming] : component.renamed)
      if (renaming.name == port) return name;
    return port;
  }

  const Model& model_;
  const Graph& graph_;
  Report& report_;
  std::map<std::string, Names> connected_;  // ports, by component
  // By component: those that it listens to, sends to or asks.
  std::map<std::string, Names> providers_;
  Names used_;  // components that others listen to, send to or ask
  Names idle_;  // components that nobody uses who works
  Names told_;  // idle components that a warning names
};

}  // namespace

void check_influence(const Model& model, const Graph& graph, Report& report) {
  Influence(model, graph, report).check();
}

}  // namespace orca::graph
