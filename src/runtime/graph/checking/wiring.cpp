// SPDX-License-Identifier: LGPL-3.0-or-later
#include "wiring.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "candidates.hpp"
#include "checking/placing/links.hpp"
#include "edges.hpp"
#include "endpoints.hpp"
#include "orca/base/text.hpp"
#include "reading/codes.hpp"
#include "reading/naming.hpp"

namespace orca::graph {
namespace {

// The properties that an end of a connection must share with the other end.
using Plug = std::tuple<Pattern, Role, std::string, std::uint64_t>;

// Returns all plugs that ports of a type have in `role`: an end that gives objects has those of all its type's
// ancestors too, because objects of the type are also theirs.
std::vector<Plug> plugs_of(const PortContract& port, Role role) {
  std::vector<Plug> plugs{{port.pattern, role, port.type.name, port.type.hash}};
  if (!is_from_end(port)) return plugs;
  for (const TypeId& ancestor : port.type.ancestors)
    plugs.emplace_back(port.pattern, role, ancestor.name, ancestor.hash);
  return plugs;
}
std::vector<Plug> plugs_of(const PortContract& port) { return plugs_of(port, port.role); }

// Returns the plugs of which a port must have one to fit this port.
std::vector<Plug> counterparts(const PortContract& port) {
  return plugs_of(port, port.role == Role::proxy ? Role::server : Role::proxy);
}

class Wiring {
 public:
  Wiring(const Model& model, Report& report) : model_(model), report_(report) {}

  void connect(const Node& connection, bool late_bound = false) {
    const Endpoint from = resolve_endpoint(connection, "from", model_, report_);
    const Endpoint to = resolve_endpoint(connection, "to", model_, report_);
    touch(from, to);
    touch(to, from);
    if (from.port == nullptr || to.port == nullptr) return doubt(from, to);
    auto edge = make_edge(connection, from, to, report_);
    if (!edge) doubt(from, to);
    if (!edge || connection.duplicate) return;
    edge->late_bound = late_bound;
    edge->link = link_of(connection, *edge, model_, report_);
    if (late_bound && is_there_already(*edge)) return;
    if (takes_one_more(*edge, from, to)) edges_.push_back(*std::move(edge));
  }

  // Connects the candidates of late-bound ports, after all written connections.
  void connect_candidates() {
    for (const CheckedComponent& component : model_.components) {
      for (const LateBinding& late : component.late) {
        if (component.duplicate || !candidates_are_names(late, report_)) continue;
        for (const std::string& name : split_names(late.candidates.value)) {
          const auto connection = candidate_connection(component, late, name, model_, report_);
          if (connection) connect(*connection, true);
          if (!connection) doubtful_.insert(component.value.name);
        }
      }
    }
  }

  void check_required() {
    if (model_.parts_missing) return;  // the connections may be in them
    index_offers();
    for (const CheckedComponent& component : model_.components) {
      const bool judged = component.contract && component.ports_known;
      if (!judged || component.duplicate || component.value.name.empty()) continue;
      for (const PortContract& port : component.contract->ports) {
        if (port.required && port.role == Role::proxy) check_connected(component, port);
      }
    }
  }

  WiredEdges result() && {
    doubt_whoever_fits();
    return {std::move(edges_), std::move(doubtful_)};
  }

 private:
  // Notes which components may lack the connection between these ends, of which at least one is wrong.
  void doubt(const Endpoint& from, const Endpoint& to) {
    doubt_end(from, to);
    doubt_end(to, from);
  }

  void doubt_end(const Endpoint& end, const Endpoint& other) {
    if (const std::string named = known_component(end.ref.component); !named.empty()) {
      doubtful_.insert(named);
    } else if (other.port != nullptr) {
      for (const Plug& plug : counterparts(*other.port)) looked_for_.insert(plug);
    } else {
      all_doubtful_ = true;
    }
  }

  // Adds the components that a connection with an unknown end may be meant for.
  void doubt_whoever_fits() {
    if (!all_doubtful_ && looked_for_.empty()) return;
    for (const CheckedComponent& component : model_.components) {
      const auto fits = [&](const PortContract& port) {
        return std::ranges::any_of(plugs_of(port), [&](const Plug& p) { return looked_for_.contains(p); });
      };
      if (all_doubtful_ || !component.contract || std::ranges::any_of(component.contract->ports, fits))
        doubtful_.insert(component.value.name);
    }
  }

  // A connection whose other end could not be found, although the graph names one.
  struct Loose {
    const PortContract* port;
    std::string component;  // named by the other end; empty: not even that is known
  };

  void touch(const Endpoint& end, const Endpoint& other) {
    if (end.port != nullptr) touched_.insert(end.ref);
    if (end.guessed) touched_.insert({end.ref.component, *end.guessed});
    if (end.perhaps != nullptr) touched_.insert({end.ref.component, end.perhaps->name});
    const bool lost = end.port == nullptr && !end.guessed;
    if (lost && other.port != nullptr) loose_.push_back({other.port, known_component(end.ref.component)});
  }

  std::string known_component(const std::string& name) const {
    return model_.component(name) == nullptr ? "" : name;
  }

  bool is_there_already(const Edge& edge) {
    const auto same = [&](const Edge& other) { return other.from == edge.from && other.to == edge.to; };
    const auto found = std::ranges::find_if(edges_, same);
    if (found == edges_.end()) return false;
    report_.error(codes::kDuplicateEdge, edge.position,
                  "the candidate " + in_quotes(edge.from.text()) + " of " + in_quotes(edge.to.text()) +
                      " is connected already at " + found->position.text());
    return true;
  }

  bool takes_one_more(const Edge& edge, const Endpoint& from, const Endpoint& to) {
    const Endpoint& proxy = from.port->role == Role::proxy ? from : to;
    if (proxy.port->many) return true;
    const auto [first, fresh] = single_.try_emplace(proxy.ref, edge);
    if (fresh) return true;
    report_.error(codes::kTooManyEdges, edge.position,
                  described(proxy) + " takes one connection and gets two: from " +
                      in_quotes(edge.from.text()) + " to " + in_quotes(edge.to.text()) + " here, from " +
                      in_quotes(first->second.from.text()) + " to " + in_quotes(first->second.to.text()) +
                      " at " + first->second.position.text());
    return false;
  }

  void check_connected(const CheckedComponent& component, const PortContract& port) {
    const PortRef ref{component.value.name, port.name};
    if (touched_.contains(ref) || component.wrongly_disabled.contains(port.name) ||
        explained_by_loose_end(ref, port))
      return;
    report_.error(codes::kUnconnected, component.value.position,
                  "component " + in_quotes(ref.component) + ": port " + in_quotes(port.name) + " (" +
                      described(port) + ") must be connected; " + offers(port));
    doubtful_.insert(ref.component);
  }

  // Returns whether a connection with an unknown end may be the one that is missing here. Reporting it as
  // missing would be a second error for one cause.
  bool explained_by_loose_end(const PortRef& ref, const PortContract& port) {
    const auto explains = [&](const Loose& loose) {
      return fit_together(*loose.port, port) && (loose.component.empty() || loose.component == ref.component);
    };
    const auto found = std::ranges::find_if(loose_, explains);
    if (found == loose_.end()) return false;
    loose_.erase(found);
    return true;
  }

  void index_offers() {
    for (const CheckedComponent& component : model_.components) {
      if (!component.contract) continue;
      for (const PortContract& port : component.contract->ports) {
        for (const Plug& plug : plugs_of(port))
          offers_[plug].push_back(component.value.name + "." + port.name);
      }
    }
  }

  std::string offers(const PortContract& wanted) {
    std::vector<std::string> offering;
    for (const Plug& plug : counterparts(wanted))
      if (const auto found = offers_.find(plug); found != offers_.end())
        offering.insert(offering.end(), found->second.begin(), found->second.end());
    if (offering.empty()) return "no component of the graph offers it";
    return "it is offered by: " + listed(offering);
  }

  const Model& model_;
  Report& report_;
  std::vector<Edge> edges_;
  std::set<std::string> doubtful_;
  std::set<Plug> looked_for_;  // ports that connections with an unknown end may be meant for
  bool all_doubtful_ = false;
  std::set<PortRef> touched_;
  std::vector<Loose> loose_;
  std::map<Plug, std::vector<std::string>> offers_;  // ports, by the plug that fits them
  std::map<PortRef, Edge> single_;                   // the first edge at each proxy that takes only one
};

}  // namespace

WiredEdges check_wiring(const std::vector<Node>& connections, const Model& model, Report& report) {
  Wiring wiring(model, report);
  for (const Node& connection : connections) wiring.connect(connection);
  wiring.connect_candidates();
  wiring.check_required();
  return std::move(wiring).result();
}

}  // namespace orca::graph
