// SPDX-License-Identifier: LGPL-3.0-or-later
#include "checking/checks.hpp"

#include <map>

#include "orca/xml/attributes.hpp"
#include "reading/codes.hpp"
#include "reading/parameters.hpp"

namespace orca::graph {
namespace {

class ConfigurationCheck {
 public:
  explicit ConfigurationCheck(const Configuration& configuration)
      : all_(configuration), graph_(configuration.graph), doubtful_(configuration.doubtful) {
    doubt_those_who_ask();
    for (const CheckedHardware& hardware : all_.model.hardware)
      if (hardware.sound) graph_.hardware.push_back(hardware.value);
    for (const CheckedComponent& component : all_.model.components)
      if (is_known(component)) graph_.components.push_back(component.value);
  }

  void run(Catalogue& catalogue, Report& report) const {
    const Candidates candidates = in_start_order();
    if (candidates.names.empty()) return;
    for (const ComponentFault& fault : catalogue.try_components(graph_, candidates)) {
      const Node& node = all_.nodes[all_.model.component_by_name.at(fault.component)];
      const std::string param = fault.param.empty() ? "" : "parameter \"" + fault.param + "\": ";
      for (const std::string_view line : xml::split(fault.text, "\n"))  // all faults of a file that it reads
        report.error(codes::kComponentRefuses, place_of_param(node, fault.param),
                     node.title() + ": " + param + std::string(line));
    }
  }

 private:
  // Returns whether the component can be made and connected. Its ports are known only if the hardware that it needs
  // is sound, and every edge ends at such components.
  static bool is_known(const CheckedComponent& component) {
    return !component.duplicate && !component.value.name.empty() && component.contract &&
           component.ports_known;
  }

  [[nodiscard]] bool is_doubtful(const ComponentNode& node) const {
    return all_.model.parts_missing || doubtful_.contains(node.name);
  }

  // A component that lacks a connection answers questions otherwise than the graph means.
  void doubt_those_who_ask() {
    std::multimap<std::string, std::string> askers;
    for (const Edge& edge : graph_.edges)
      if (edge.pattern == Pattern::query) askers.emplace(edge.to.component, edge.from.component);
    std::vector<std::string> left(doubtful_.begin(), doubtful_.end());
    while (!left.empty()) {
      const auto [first, last] = askers.equal_range(left.back());
      left.pop_back();
      for (auto asker = first; asker != last; ++asker)
        if (doubtful_.insert(asker->second).second) left.push_back(asker->second);
    }
  }

  // Returns the components that can be tried, each after those that must be up before it, as far as these can.
  [[nodiscard]] Candidates in_start_order() const {
    std::vector<const ComponentNode*> nodes;
    for (const CheckedComponent& component : all_.model.components)
      if (is_known(component) && component.sound) nodes.push_back(&component.value);
    std::multimap<std::string, std::size_t> followers;  // by the name of who must be up before
    std::vector<std::size_t> awaited;                   // of each node
    std::vector<std::size_t> ready;                     // in the order in which they come up
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      for (const std::string& name : nodes[i]->start_after) followers.emplace(name, i);
      awaited.push_back(nodes[i]->start_after.size());
      if (awaited[i] == 0) ready.push_back(i);
    }
    Candidates result;
    const auto take = [&](std::size_t i, bool doubtful) {
      result.names.push_back(nodes[i]->name);
      if (doubtful) result.doubtful.insert(nodes[i]->name);
    };
    for (std::size_t done = 0; done < ready.size(); ++done) {
      const std::size_t next = ready[done];
      take(next, is_doubtful(*nodes[next]));
      const auto [first, last] = followers.equal_range(nodes[next]->name);
      for (auto follower = first; follower != last; ++follower)
        if (--awaited[follower->second] == 0) ready.push_back(follower->second);
    }
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (awaited[i] > 0) take(i, true);
    return result;
  }

  const Configuration& all_;
  Graph graph_;
  std::set<std::string> doubtful_;
};

}  // namespace

void check_configuration(const Configuration& configuration, Catalogue& catalogue, Report& report) {
  ConfigurationCheck(configuration).run(catalogue, report);
}

}  // namespace orca::graph
