// SPDX-License-Identifier: LGPL-3.0-or-later
#include "checking/checks.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "checking/trading/providers.hpp"
#include "checking/wiring.hpp"
#include "endpoints.hpp"
#include "orca/base/text.hpp"
#include "reading/codes.hpp"
#include "reading/naming.hpp"
#include "reading/values.hpp"

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

  void connect(const Node& connection) {
    const bool has_both = connection.find("from") != nullptr && connection.find("to") != nullptr;
    if (connection.find("seek") != nullptr && !has_both) return trade(connection);
    check_no_trade(connection);
    join(connection);
  }

  // Connects the candidates of late-bound ports, after all written connections.
  void connect_candidates() {
    for (const CheckedComponent& component : model_.components) {
      for (const LateBinding& late : component.late) {
        if (component.duplicate) continue;
        const auto names = candidate_names(component, late, model_, report_);
        if (!names) doubtful_.insert(component.value.name);
        for (const std::string& name : names.value_or(std::vector<std::string>{})) {
          const auto connection = candidate_connection(component, late, name, model_, report_);
          if (connection) join(*connection, true);
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
  void join(const Node& connection, bool late_bound = false) {
    const Endpoint from = resolve_endpoint(connection, "from", model_, report_);
    const Endpoint to = resolve_endpoint(connection, "to", model_, report_);
    touch(from, to);
    touch(to, from);
    if (from.port == nullptr || to.port == nullptr) return doubt(from, to);
    auto edge = make_edge(connection, from, to, report_);
    if (!edge) doubt(from, to);
    if (!edge || connection.duplicate) return;
    edge->late_bound = late_bound;
    edge->choice = read_choice(connection, from.port->role == Role::proxy ? from : to);
    edge->link = link_of(connection, *edge, model_, report_);
    if (late_bound && is_there_already(*edge)) return;
    if (takes_one_more(*edge, from, to)) edges_.push_back(*std::move(edge));
  }

  // --- Trading

  // Connects a proxy with everything that fits what it seeks.
  void trade(const Node& connection) {
    const char* const attribute = connection.find("from") != nullptr ? "from" : "to";
    if (connection.find(attribute) == nullptr)
      return doubt({}, {});  // it has no end at all, which is reported
    const Endpoint client = resolve_endpoint(connection, attribute, model_, report_);
    touch(client, {});
    if (client.port == nullptr) return doubt(client, {});
    if (connection.duplicate) return;
    const bool good = check_trader(connection, client, attribute);
    for (const Node& choice : good ? choices_of(connection, client, attribute) : std::vector<Node>{}) {
      const std::size_t errors = report_.diagnostics().error_count();
      join(choice);
      if (report_.diagnostics().error_count() != errors) return;  // what is wrong with one is with the others
    }
    if (!good) doubt(client, {});
  }

  // Returns the connections that a proxy with a wish chooses from.
  std::vector<Node> choices_of(const Node& connection, const Endpoint& client, const char* attribute) {
    const Text* const seek = connection.known("seek");
    if (seek == nullptr) return doubt(client, {}), std::vector<Node>{};
    const Wish wish{client.ref, *client.port, "seek", *seek, connection.known("prefer"), connection.context};
    const auto providers = find_providers(wish, model_, report_);
    if (!providers) return doubt(client, {}), std::vector<Node>{};
    std::vector<Node> choices;
    for (const std::string& provider : *providers) {
      Node choice = connection;
      const char* const other = std::string_view(attribute) == "from" ? "to" : "from";
      choice.attributes.insert_or_assign(other, Text{provider, seek->position, true, seek->named_in});
      choice.attributes.insert_or_assign(
          "choice", Text{std::to_string(choices.size() + 1), seek->position, true, seek->named_in});
      choices.push_back(std::move(choice));
    }
    return choices;
  }

  // Returns false after a report that the port cannot seek anything.
  bool check_trader(const Node& connection, const Endpoint& client, const char* attribute) {
    const auto refuse = [&](const char* place, const std::string& why) {
      report_.error(codes::kTrade, connection.place(place), why);
      return false;
    };
    const bool is_from = std::string_view(attribute) == "from";
    if (client.port->role != Role::proxy || is_from_end(*client.port) != is_from)
      return refuse(attribute,
                    std::string(attribute) + ": " + described(client) +
                        " seeks nothing; a PushProxy does as to, a QueryProxy or SendProxy as from");
    if (client.port->many)
      return refuse("seek", described(client) +
                                " takes any number of connections; say in its component which: " +
                                "<port name=" + in_quotes(client.ref.port) + " candidates=\"...\"/>");
    if (connection.find("choice") != nullptr)
      return refuse("choice", "choice: seek numbers its connections itself; remove choice");
    return true;
  }

  void check_no_trade(const Node& connection) {
    if (connection.find("seek") != nullptr) return;  // there is one end too many, which is reported
    if (connection.find("prefer") != nullptr)
      report_.error(codes::kTrade, connection.place("prefer"),
                    "prefer has a meaning only with seek; remove it");
  }

  std::uint32_t read_choice(const Node& connection, const Endpoint& proxy) {
    const Text* const text = connection.find("choice");
    if (text == nullptr) return 0;
    const auto read = read_value(*text, connection.rule->attribute("choice")->value, "choice", report_);
    if (!proxy.port->many) return read ? static_cast<std::uint32_t>(std::get<std::int64_t>(*read)) : 0;
    report_.error(
        codes::kTrade, connection.place("choice"),
        "choice has no meaning for " + described(proxy) + ", which uses all its connections; remove it");
    return 0;
  }

  // --- What may be missing

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
    const CheckedComponent* const component = model_.component(proxy.ref.component);
    const PortSetting setting =
        component == nullptr ? PortSetting{} : setting_of(component->value, proxy.ref.port);
    if (!setting.speaks_outside()) return single_.add(edge, proxy);
    const bool is_topic = !setting.topic.empty();
    report_.error(is_topic ? codes::kTopic : codes::kTeam, edge.position,
                  described(proxy) + " hears " +
                      (is_topic ? "topic " + setting.topic + " already; remove the topic"
                                : "the team already; remove team=") +
                      " or the connection");
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
  Choices single_{report_};                          // the edges at proxies that use one at a time
};

}  // namespace

WiredEdges check_wiring(const std::vector<Node>& connections, const Model& model, Report& report) {
  Wiring wiring(model, report);
  for (const Node& connection : connections) wiring.connect(connection);
  wiring.connect_candidates();
  wiring.check_required();
  WiredEdges wired = std::move(wiring).result();
  if (!model.any_link) check_room_for_dds(wired.edges, report);
  return wired;
}

}  // namespace orca::graph
