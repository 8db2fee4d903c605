// SPDX-License-Identifier: LGPL-3.0-or-later
#include "checking/checks.hpp"

#include <cstdint>
#include <set>
#include <string>

#include "orca/base/text.hpp"
#include "ports.hpp"
#include "reading/codes.hpp"
#include "reading/laps.hpp"
#include "reading/naming.hpp"
#include "reading/parameters.hpp"
#include "reading/trading/properties.hpp"
#include "reading/values.hpp"

namespace orca::graph {
namespace {

constexpr std::size_t kMostComponents = 10'000;

// A reader for one component. Each component needs a new one.
class ComponentReader {
 public:
  ComponentReader(const Node& node, Types& types, const Model& model, Report& report)
      : node_(node), types_(types), model_(model), report_(report) {}

  CheckedComponent read() {
    checked_.duplicate = node_.duplicate;
    checked_.value.position = node_.position;
    checked_.value.name = node_.value("name");
    checked_.value.type = node_.value("type");
    checked_.value.hardware = node_.value("hardware");
    check_name(node_, "name", report_);
    read_contract();
    read_ports(node_, checked_, types_.catalogue(), report_);
    read_scheduling();
    read_loading();
    read_trigger();
    read_content();
    return std::move(checked_);
  }

 private:
  bool names_hardware() const { return node_.find("hardware") != nullptr && !hardware_left_out(); }
  // Returns whether hardware="" cancels what another part of the graph says.
  bool hardware_left_out() const {
    return node_.known("hardware") != nullptr && node_.value("hardware").empty();
  }

  void read_contract() {
    const CheckedHardware* hardware = names_hardware() ? find_hardware() : nullptr;
    if (names_hardware() && (hardware == nullptr || !hardware->sound)) {
      checked_.contract = types_.component_without_hardware(node_);
      check_hardware_wanted();
      checked_.ports_known = checked_.contract != nullptr && !checked_.contract->needs_hardware;
      return;
    }
    if (hardware != nullptr) {
      const HardwareUse use{hardware->value.name, hardware->value.type, hardware->value.params};
      checked_.contract = types_.component(node_, &use);
      check_hardware_wanted();
      checked_.ports_known = checked_.contract != nullptr;
      return;
    }
    checked_.contract = types_.component(node_, nullptr);
    if (!checked_.contract) return;
    checked_.ports_known = !checked_.contract->needs_hardware;
    if (checked_.contract->needs_hardware) report_missing_hardware();
  }

  const CheckedHardware* find_hardware() {
    const Text* name = node_.known("hardware");
    if (name == nullptr) return nullptr;
    const CheckedHardware* hardware = model_.find_hardware(name->value);
    if (hardware == nullptr)
      report_unknown(node_, *name, codes::kUnknownHardware, "hardware", model_.hardware_names, "", model_,
                     report_);
    return hardware;
  }

  void check_hardware_wanted() {
    if (!checked_.contract || checked_.contract->needs_hardware) return;
    report_.error(
        codes::kHardwareNotTaken, node_.place("hardware"),
        node_.title() + ": " + checked_.contract->type + " takes no hardware; remove the attribute");
  }

  void report_missing_hardware() {
    report_.error(
        codes::kHardwareMissing, node_.position,
        node_.title() + ": " + checked_.contract->type +
            " needs a hardware: add hardware=\"NAME\"; the graph has: " + listed(model_.hardware_names));
  }

  // Returns the value of an attribute, by its rule.
  template <class T>
  std::optional<T> attribute(const char* name) {
    return read_attribute<T>(node_, name, report_);
  }

  void read_scheduling() {
    if (const auto priority = attribute<std::int64_t>("priority"))
      checked_.value.priority = static_cast<int>(*priority);
    if (const auto autonomous = attribute<bool>("autonomous")) checked_.value.autonomous = *autonomous;
    checked_.value.watchable = attribute<bool>("watchable").value_or(false);
    checked_.value.takes = read_lap_time(node_, report_);
    checked_.value.restore_last = attribute<std::string>("restore") == "last";
    checked_.value.may_fail = attribute<bool>("may_fail").value_or(false);
    checked_.value.start_after = split_names(node_.value("start_after"));
    checked_.value.may_set = split_names(node_.value("may_set"));
    checked_.value.may_suspend = split_names(node_.value("may_suspend"));
  }

  void read_loading() {
    constexpr Duration kIdleTime = std::chrono::seconds(10);
    checked_.value.on_demand = attribute<std::string>("start") == "on_demand";
    const bool warm = attribute<std::string>("stay") == "warm";
    const auto idle_time = attribute<double>("idle_time");
    if (!checked_.value.on_demand) return check_never_unloaded();
    checked_.value.stay_warm = warm;
    if (!warm) checked_.value.idle_time = idle_time ? from_seconds(*idle_time) : kIdleTime;
    if (checked_.value.autonomous.value_or(false))
      report_.error(codes::kLoading, node_.place("start"),
                    node_.title() +
                        ": it is autonomous, so it works from the start, whether asked for or not; "
                        "take start=\"on_demand\" or autonomous=\"true\" away");
  }

  void check_never_unloaded() {
    if (node_.find("idle_time") != nullptr)
      report_.error(codes::kLoading, node_.place("idle_time"),
                    node_.title() +
                        ": idle_time is for components with start=\"on_demand\"; this one stays "
                        "loaded all the time");
  }

  void read_trigger() {
    if (node_.find("period") != nullptr && node_.find("on") != nullptr) {
      return report_.error(codes::kTwoTriggers, node_.place("on"),
                           node_.title() + ": period and on exclude each other; one of them starts the laps");
    }
    if (const auto period = attribute<double>("period"))
      checked_.value.trigger = Trigger{Trigger::Kind::period, from_seconds(*period), {}};
    if (const Text* on = node_.known("on")) return read_port_trigger(*on);
    for (const char* name : {"fuse", "within", "at_least_every"})
      if (node_.find("on") == nullptr && node_.find(name) != nullptr)
        report_.error(codes::kTwoTriggers, node_.place(name),
                      node_.title() + ": " + name + " is for laps that start on ports; name them with on");
  }

  void read_port_trigger(const Text& on) {
    const std::string fuse = attribute<std::string>("fuse").value_or("any");
    const auto limit = attribute<double>("at_least_every");
    Trigger trigger{Trigger::Kind::on_any, from_seconds(limit.value_or(0.0)), split_names(on.value)};
    if (fuse == "all") trigger.kind = Trigger::Kind::on_all;
    bool are_ports = !trigger.ports.empty() || check_trigger_port(on, "");
    for (const std::string& port : trigger.ports) are_ports = check_trigger_port(on, port) && are_ports;
    check_named_once(on, trigger.ports);
    read_moment(on, fuse == "stamps", trigger);
    if (are_ports) checked_.value.trigger = trigger;
  }

  void check_named_once(const Text& on, const std::vector<std::string>& names) {
    std::set<std::string> seen;
    for (const std::string& name : names)
      if (!seen.insert(name).second)
        report_.error(codes::kTriggerPort, on.position,
                      node_.title() + ": on names " + in_quotes(name) + " twice; name it once");
  }

  void read_moment(const Text& on, bool by_stamps, Trigger& trigger) {
    const auto within = attribute<double>("within");
    if (!by_stamps && node_.find("within") != nullptr)
      return report_.error(codes::kTwoTriggers, node_.place("within"),
                           node_.title() +
                               ": within is for laps that start on objects of one moment; say so with "
                               "fuse=\"stamps\", or remove it");
    if (!by_stamps) return;
    trigger.kind = Trigger::Kind::on_stamps;
    trigger.within = from_seconds(within.value_or(0.0));
    if (trigger.ports.size() == 1 && !is_array(trigger.ports.front()))
      report_.error(codes::kTwoTriggers, node_.place("fuse"),
                    node_.title() +
                        ": fuse=\"stamps\" compares the objects of several servers, and on names only " +
                        in_quotes(on.value) + ", which has one; name another port in on, or remove fuse");
  }

  // Returns whether the port may have several servers; what is wrong with its name is reported already.
  [[nodiscard]] bool is_array(const std::string& name) const {
    const PortContract* const port = checked_.contract ? checked_.contract->port(name) : nullptr;
    return port == nullptr || port->many;
  }

  // Returns false after a report.
  bool check_trigger_port(const Text& on, const std::string& name) {
    if (!checked_.contract || !checked_.ports_known) return true;
    const PortContract* const refused = checked_.refused_port(name);
    const std::string& wanted = refused == nullptr ? name : refused->name;
    std::vector<std::string> inputs;
    for (const PortContract& port : checked_.contract->ports) {
      if (port.pattern != Pattern::push || port.role != Role::proxy) continue;
      if (port.name == wanted) return true;
      inputs.push_back(port.name);
    }
    const bool exists = checked_.contract->port(wanted) != nullptr;
    report_.error(codes::kTriggerPort, on.position,
                  node_.title() + ": on=" + in_quotes(name) +
                      (exists ? " is not a PushProxy, only what is pushed to a component can start its laps"
                              : " is not a port of it") +
                      "; its PushProxies are: " + listed(inputs) + report_.hint(name, inputs));
    return false;
  }

  void read_content() {
    if (checked_.contract) {
      ReadParams params = read_params(node_, *checked_.contract, report_);
      checked_.sound = params.sound();
      if (params.sound()) checked_.value.params = std::move(params.values);
      checked_.value.here = std::move(params.here);
    }
    checked_.value.properties = read_properties(node_, report_);
  }

  const Node& node_;
  Types& types_;
  const Model& model_;
  Report& report_;
  CheckedComponent checked_;
};

void check_start_after(const std::vector<Node>& nodes, const Model& model, Report& report) {
  for (const Node& node : nodes) {
    for (const std::string& name : split_names(node.value("start_after"))) {
      check_component_exists(name, node.place("start_after"), node.title() + ": start_after", model, report);
    }
  }
}

// Returns what is wrong with a right to set a parameter of a component whose contract is known.
std::string fault_of_right(const std::string& param, const Contract& contract, Report& report) {
  const ParamContract* const found = contract.param(param);
  if (found != nullptr && !found->fixed) return "";
  if (found != nullptr) return "is fixed while the component runs; nobody can set it then";
  std::vector<std::string> names;
  for (const ParamContract& one : contract.params)
    if (!one.fixed) names.push_back(one.name);
  return "is no parameter of " + contract.type + "; those that can be set are: " + listed(names) +
         report.hint(param, names);
}

// Nobody would let a component go on that has suspended itself.
void check_rights_to_suspend(const Node& node, const Model& model, Report& report) {
  const std::string title = node.title() + ": may_suspend";
  for (const std::string& name : split_names(node.value("may_suspend"))) {
    if (!check_component_exists(name, node.place("may_suspend"), title, model, report)) continue;
    if (name == node.value("name"))
      report.error(codes::kRight, node.place("may_suspend"),
                   title + ": " + in_quotes(name) +
                       " is the component itself, which could not let itself go on; name another one");
  }
}

void check_rights_to_set(const std::vector<Node>& nodes, const Model& model, Report& report) {
  for (const Node& node : nodes)
    for (const std::string& right : split_names(node.value("may_set"))) {
      const std::size_t dot = right.rfind('.');
      const auto refuse = [&](const std::string& why) {
        report.error(codes::kRight, node.place("may_set"),
                     node.title() + ": may_set: " + in_quotes(right) + " " + why);
      };
      if (dot == std::string::npos || dot == 0 || dot + 1 == right.size()) {
        refuse("names no parameter of a component; write COMPONENT.PARAM, for example pilot.max_speed");
        continue;
      }
      const std::string name = right.substr(0, dot);
      if (!check_component_exists(name, node.place("may_set"), node.title() + ": may_set", model, report))
        continue;
      const CheckedComponent& component = *model.component(name);
      if (!component.contract) continue;
      const std::string fault = fault_of_right(right.substr(dot + 1), *component.contract, report);
      if (!fault.empty()) refuse(fault);
    }
}

}  // namespace

void check_components(const std::vector<Node>& nodes, Types& types, Model& model, Report& report) {
  for (const Node& node : nodes) {
    if (model.components.size() == kMostComponents) {
      report.error(codes::kTooManyComponents, node.position,
                   "the graph has " + std::to_string(nodes.size()) + " components, the limit is " +
                       std::to_string(kMostComponents));
      break;
    }
    model.add(ComponentReader(node, types, model, report).read(),
              !node.value("name").empty() && !node.duplicate);
  }
  check_start_after(nodes, model, report);
  check_rights_to_set(nodes, model, report);
  for (const Node& node : nodes) check_rights_to_suspend(node, model, report);
}

}  // namespace orca::graph
