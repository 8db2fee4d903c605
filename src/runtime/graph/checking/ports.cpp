// SPDX-License-Identifier: LGPL-3.0-or-later
#include "ports.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <string_view>

#include "endpoints.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/names.hpp"
#include "reading/codes.hpp"
#include "reading/naming.hpp"
#include "reading/values.hpp"
#include "team.hpp"

namespace orca::graph {
namespace {

// Names of ROS 2 are tokens of letters, digits and '_' that begin with no digit. Returns what is wrong with one; empty if nothing is.
std::string token_fault(std::string_view token) {
  constexpr auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  constexpr auto is_good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || (c >= '0' && c <= '9');
  };
  if (token.empty()) return "a part between two '/', or the last one, is empty";
  if (is_digit(token.front())) return "no part of it begins with a digit";
  if (const auto bad = std::ranges::find_if_not(token, is_good); bad != token.end())
    return std::string("'") + *bad + "' cannot be in it; letters, digits and '_' can";
  return token.find("__") == std::string_view::npos ? "" : "'__' cannot be in it";
}

// Returns what is wrong with the name of a topic; empty if nothing is.
std::string topic_fault(std::string_view topic) {
  constexpr std::size_t kLongest = 200;
  if (!topic.starts_with('/')) return "expected a name that begins with '/', such as /scan";
  if (topic.size() > kLongest) return "it is longer than 200 characters";
  std::string fault;
  while (fault.empty() && !topic.empty()) {
    topic.remove_prefix(1);  // the slash
    const std::string_view token = topic.substr(0, topic.find('/'));
    fault = token_fault(token);
    topic.remove_prefix(token.size());
  }
  return fault;
}

class PortReader {
 public:
  PortReader(const Node& component, CheckedComponent& checked, const Catalogue& catalogue, Report& report)
      : component_(component), checked_(checked), catalogue_(catalogue), report_(report) {}

  void read(const Node& node) {
    const Text* name = node.known("name");
    if (name == nullptr) return;
    if (node.duplicate) return note_refused(node, name->value);
    const PortContract* port = find(node, *name);
    if (port == nullptr) return;
    title_ = component_.title() + ": port " + in_quotes(name->value);
    PortSetting setting;
    setting.disabled = read_disabled(node, *port);
    if (setting.disabled && node.find("as") == nullptr && node.find("candidates") == nullptr &&
        node.find("topic") == nullptr && node.find("team") == nullptr) {
      disabled_.push_back(port->name);
      checked_.disabled[port->name] = node.position;
    } else if (setting.disabled) {
      note_refused(node, port->name);
      return report_.error(codes::kPortSetting, node.place("disabled"),
                           title_ + " is disabled: nothing else can be said about it");
    }
    setting.alias = read_alias(node, *port);
    read_candidates(node, setting.alias.empty() ? port->name : setting.alias, *port);
    read_topic(node, *port, setting);
    read_team(node, *port, setting);
    if (setting.disabled || !setting.alias.empty() || setting.speaks_outside())
      checked_.value.ports[port->name] = setting;
  }

  // Applies the changes at the end, so that every <port> sees the author's names. Other components of the type keep theirs.
  void apply() {
    if (disabled_.empty() && checked_.renamed.empty() && wrongly_disabled_.empty() && outside_.empty())
      return;
    const auto changed = std::make_shared<Contract>(*checked_.contract);
    Contract& contract = *changed;
    std::erase_if(contract.ports, [&](const PortContract& port) {
      return std::ranges::find(disabled_, port.name) != disabled_.end();
    });
    for (PortContract& port : contract.ports) {
      if (outside_.contains(port.name)) port.required = false;
      const auto renaming = checked_.renamed.find(port.name);
      if (std::ranges::find(wrongly_disabled_, port.name) != wrongly_disabled_.end())
        checked_.wrongly_disabled.insert(renaming == checked_.renamed.end() ? port.name
                                                                            : renaming->second.name);
      if (renaming != checked_.renamed.end()) port.name = renaming->second.name;
    }
    for (auto& [name, port] : checked_.refused_names)
      if (const auto renaming = checked_.renamed.find(port); renaming != checked_.renamed.end())
        port = renaming->second.name;
    checked_.contract = changed;
  }

 private:
  // Notes the name that a refused <port> gives, so that connections to it are not refused as well.
  void note_refused(const Node& node, const std::string& port) {
    if (const Text* alias = node.known("as")) checked_.refused_names.emplace(alias->value, port);
  }

  const PortContract* find(const Node& node, const Text& name) {
    const Contract& contract = *checked_.contract;
    const auto found = std::ranges::find(contract.ports, name.value, &PortContract::name);
    if (found != contract.ports.end()) return &*found;
    std::vector<std::string> names;
    for (const PortContract& port : contract.ports) names.push_back(port.name);
    const auto near = report_.nearest(name.value, names);
    note_refused(node, near.value_or(""));
    report_.error(codes::kUnknownPort, name.position,
                  component_.title() + ": port " + in_quotes(name.value) + " does not exist; " +
                      contract.type + " has " + ports_of(contract) + xml::did_you_mean(near));
    return nullptr;
  }

  bool read_disabled(const Node& node, const PortContract& port) {
    const Text* disabled = node.find("disabled");
    const auto value = disabled == nullptr ? std::nullopt
                                           : read_value(*disabled, node.rule->attribute("disabled")->value,
                                                        title_ + ": disabled", report_);
    if (!value || !std::get<bool>(*value)) return false;
    if (!port.required) return true;
    report_.error(codes::kPortNeeded, disabled->position,
                  title_ + " (" + described(port) + ") must be connected, so it cannot be disabled");
    wrongly_disabled_.push_back(port.name);
    return false;
  }

  // Returns the new name; empty: it keeps the old one.
  std::string read_alias(const Node& node, const PortContract& port) {
    const Text* alias = node.known("as");
    if (alias == nullptr || alias->value == port.name) return {};
    const auto fault = alias->value.find('/') == std::string::npos ? name_fault(alias->value)
                                                                   : "a port has no contexts, so no '/'";
    if (fault) {
      report_.error(codes::kBadName, alias->position,
                    title_ + ": as: the name " + in_quotes(alias->value) + ": " + *fault);
      return refuse_alias(*alias, port);
    }
    if (is_taken(alias->value)) {
      report_.error(
          codes::kDuplicateName, alias->position,
          title_ + ": as: " + component_.title() + " has a port " + in_quotes(alias->value) + " already");
      return refuse_alias(*alias, port);
    }
    checked_.renamed[port.name] = {alias->value, node.position};
    return alias->value;
  }

  std::string refuse_alias(const Text& alias, const PortContract& port) {
    checked_.refused_names.emplace(alias.value, port.name);
    return {};
  }

  // Returns whether a name is taken. Even a name that is given up is not free: an error about its use must be
  // able to name the new one.
  bool is_taken(const std::string& name) const {
    const auto has_it = [&](const auto& entry) { return entry.second.name == name; };
    return checked_.contract->port(name) != nullptr || std::ranges::any_of(checked_.renamed, has_it);
  }

  void read_candidates(const Node& node, const std::string& name, const PortContract& port) {
    const Text* candidates = node.known("candidates");
    if (candidates == nullptr) return;
    if (port.many) return checked_.late.push_back({name, *candidates, node.context});
    report_.error(codes::kNoLateBinding, candidates->position,
                  title_ + " (" + described(port) +
                      ") takes no candidates: only a port array chooses whom it listens to at run time; "
                      "use <connect>");
  }

  // --- Topics

  void read_topic(const Node& node, const PortContract& port, PortSetting& setting) {
    const Text* const topic = node.known("topic");
    const Text* const message = node.known("message");
    if (topic == nullptr) {
      if (message != nullptr)
        report_.error(codes::kTopic, message->position,
                      title_ + ": message has a meaning only with topic; remove it");
      return;
    }
    outside_.insert(port.name);  // what is wrong with it is reported here
    if (const std::string fault = topic_fault(topic->value); !fault.empty())
      return report_.error(codes::kTopic, topic->position,
                           title_ + ": topic " + in_quotes(topic->value) + ": " + fault);
    if (component_.value("start") == "on_demand")
      return report_.error(
          codes::kTopic, topic->position,
          title_ + ": a component that starts on demand has no topics; remove start or topic");
    const std::vector<std::string> messages = port.pattern == Pattern::query
                                                  ? std::vector<std::string>{}
                                                  : catalogue_.messages(port.type.name, is_from_end(port));
    if (messages.empty())
      return report_.error(codes::kTopic, topic->position,
                           title_ + " (" + described(port) + ") has no topic: ROS 2 has no message for " +
                               (port.pattern == Pattern::query ? "questions" : port.type.name));
    if (message != nullptr && std::ranges::find(messages, message->value) == messages.end())
      return report_.error(codes::kTopic, message->position,
                           title_ + ": message " + in_quotes(message->value) + " does not fit " +
                               port.type.name + "; expected " + listed(messages) +
                               xml::did_you_mean(report_.nearest(message->value, messages)));
    setting.topic = topic->value;
    if (message != nullptr) setting.message = message->value;
  }

  void read_team(const Node& node, const PortContract& port, PortSetting& setting) {
    const Text* const team = node.known("team");
    if (team == nullptr) return;
    outside_.insert(port.name);
    const bool on_demand = component_.value("start") == "on_demand";
    const std::string fault = on_demand ? "a component that starts on demand has no ports in a team"
                              : setting.topic.empty() ? team_fault(team->value, port)
                                                      : "the port has a topic as well; remove one of the two";
    if (!fault.empty())
      return report_.error(
          codes::kTeam, team->position,
          title_ + " (" + described(port) + "): team " + in_quotes(team->value) + ": " + fault);
    setting.team = team->value;
  }

  const Node& component_;
  CheckedComponent& checked_;
  const Catalogue& catalogue_;
  Report& report_;
  std::string title_;
  std::vector<std::string> disabled_;
  std::vector<std::string> wrongly_disabled_;
  std::set<std::string> outside_;  // ports with a topic or in the team
};

}  // namespace

void read_ports(const Node& node, CheckedComponent& component, const Catalogue& catalogue, Report& report) {
  if (!component.contract || !component.ports_known) return;
  PortReader reader(node, component, catalogue, report);
  for (const Node& child : node.children)
    if (child.is("port")) reader.read(child);
  reader.apply();
}

void check_topics(const Model& model, const Catalogue& catalogue, Report& report) {
  struct Use {
    std::string port;
    std::string message;
  };
  std::map<std::string, Use> known;  // by topic
  for (const CheckedComponent& component : model.components) {
    for (const auto& [name, setting] : component.value.ports) {
      const std::string& alias = setting.alias.empty() ? name : setting.alias;
      const PortContract* const port = component.contract ? component.contract->port(alias) : nullptr;
      if (setting.topic.empty() || port == nullptr) continue;
      Use use{component.value.name + "." + alias, setting.message};
      if (use.message.empty()) use.message = catalogue.messages(port->type.name, is_from_end(*port)).front();
      const Use& first = known.try_emplace(setting.topic, use).first->second;
      if (first.message != use.message)
        report.error(codes::kTopic, component.value.position,
                     in_quotes(use.port) + " says or hears " + use.message + " on topic " + setting.topic +
                         ", and " + in_quotes(first.port) + " " + first.message +
                         "; give one of them another topic or message");
    }
  }
}

void check_security(const Graph& graph, const Model& model, Report& report) {
  if (!graph.secured) return;
  for (const CheckedComponent& component : model.components)
    for (const auto& [name, setting] : component.value.ports)
      if (!setting.topic.empty())
        report.error(
            codes::kSecured, component.value.position,
            in_quotes(component.value.name + "." + name) + " speaks to ROS 2 on topic " + setting.topic +
                ", which is plain, and the graph says security=\"on\"; remove the topic or security: a "
                "graph cannot have both");
}

std::string ports_of(const Contract& contract) {
  std::vector<std::string> in;
  std::vector<std::string> out;
  for (const PortContract& port : contract.ports) (is_from_end(port) ? out : in).push_back(port.name);
  if (in.empty() && out.empty()) return "no ports";
  std::string result;
  if (!in.empty()) result = "in: " + listed(in);
  if (!out.empty()) result += (result.empty() ? "out: " : "; out: ") + listed(out);
  return result;
}

}  // namespace orca::graph
