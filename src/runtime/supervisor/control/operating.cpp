// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/operating.hpp"

#include <algorithm>
#include <memory>
#include <set>
#include <utility>

#include "orca/base/log.hpp"
#include "orca/base/text.hpp"
#include "orca/graph/print.hpp"
#include "orca/graph/settings.hpp"
#include "orca/host/component_state.hpp"
#include "orca/supervisor/log_name.hpp"
#include "orca/xml/names.hpp"

namespace orca::supervisor {
namespace {

using Nodes = std::vector<const graph::ComponentNode*>;

// A component of a group, and its state before an order. Nodes of the graph may move while the order waits.
struct StateBefore {
  std::string component;
  std::string process;
  std::string state;
};

std::vector<std::string> names_of(const Nodes& nodes) {
  std::vector<std::string> names;
  for (const graph::ComponentNode* const node : nodes) names.push_back(node->name);
  return names;
}

// Returns the error of an order that has waited for another one, after which its component was not there any more.
Error gone(const std::string& component) {
  return fail(Code::not_found, "the system does not have it any more", component);
}

Pairs pairs_of(const graph::Params& params) {
  const std::map<std::string, std::string> texts = graph::print_values(params);
  return {texts.begin(), texts.end()};
}

// Puts a title before each line of a text.
std::string titled(const std::string& lines, const std::string& title) {
  std::string result = title;
  for (const char c : lines) result += c == '\n' ? "\n" + title : std::string(1, c);
  return result;
}

}  // namespace

// A reader of what an operator wants to set. It goes on after an error, to report all of them.
class Operating::SettingReader {
 public:
  explicit SettingReader(const Operating& operating) : operating_(operating) {}

  Result<std::vector<Setting>> read(const std::vector<std::string>& words) {
    for (std::size_t i = 0; i + 1 < words.size(); i += 2) take(words[i], words[i + 1]);
    if (words.size() % 2 != 0) note(fail(Code::invalid_argument, "which value? for " + words.back()));
    const bool is_alone = words.size() == 2;
    for (Setting& setting : settings_) read_values(setting, is_alone ? "" : setting.component + ": ");
    if (errors_.empty()) return std::move(settings_);
    return fail(code_, joined(errors_, "\n"));
  }

 private:
  void take(const std::string& what, const std::string& value) {
    const Result<ParamName> name = operating_.find(what);
    if (!name) return note(name.error());
    const std::string& owner = name->owner.name;
    if (name->param.empty() || name->owner.contract == nullptr)
      return note(fail(Code::invalid_argument, "name one parameter: " + owner + ".PARAM"));
    if (name->owner.hardware != nullptr) return note(only_anew(*name, value));
    auto setting = std::ranges::find(settings_, owner, &Setting::component);
    if (setting == settings_.end()) setting = settings_.insert(setting, {owner, {}, {}});
    if (!setting->texts.emplace(name->param, value).second)
      note(fail(Code::invalid_argument, what + " is given twice; give it one value"));
  }

  // A driver reads its parameters when it is made, since the endpoints that it offers hang on them.
  [[nodiscard]] Error only_anew(const ParamName& name, const std::string& value) const {
    const Result<graph::Params> read =
        graph::read_settings(name.owner.contract->params, {{name.param, value}});
    if (!read) return read.error();
    const std::string file = operating_.present_.plugin_of(*name.owner.hardware);
    return fail(
        Code::failed_precondition,
        name.owner.name + "." + name.param +
            ": a driver reads its parameters only when it begins; this puts it in anew, for which the "
            "robot stops: orcactl swap " +
            name.owner.name + " " + file + " --set " + name.param + "=" + in_quotes(value));
  }

  void read_values(Setting& setting, const std::string& title) {
    const Contract* const contract =
        operating_.present_.contract_of(setting.component);  // take() has seen it
    Result<graph::Params> values = graph::read_settings(contract->params, setting.texts);
    if (values) {
      setting.values = std::move(values).value();
    } else {
      note(fail(values.error().code, titled(values.error().message, title)));
    }
  }

  void note(const Error& error) {
    if (errors_.empty()) code_ = error.code;
    errors_.push_back(error.message);
  }

  const Operating& operating_;
  std::vector<Setting> settings_;  // one for each component
  std::vector<std::string> errors_;
  Code code_ = Code::invalid_argument;
};

Operating::Operating(Conductor& conductor, const graph::Graph& graph, const SystemFacts& facts,
                     const SystemNames& names, host::Reports reports, RunLevers levers)
    : conductor_(conductor),
      graph_(graph),
      names_(names),
      reports_(std::move(reports)),
      levers_(std::move(levers)),
      present_(graph, facts),
      joint_orders_(conductor, [this](const std::string& component, Order order) {
        return send(component, std::move(order));
      }) {}

Status Operating::send(const std::string& component, Order order) const {
  const Result<Member*> member = ready_member_of(component);
  if (!member) return member.error();
  const std::optional<Answer> answer = conductor_.ask(**member, std::move(order));
  if (answer) return answer->outcome;
  return fail(Code::unavailable, "process " + (*member)->name() + " has ended before it answered");
}

void Operating::tell(const std::string& component, Order order) const {
  if (const Result<Member*> member = ready_member_of(component)) (*member)->tell(std::move(order));
}

std::string Operating::process_of(const std::string& component) const {
  const graph::ComponentNode* const node = graph_.find_component(component);
  if (node != nullptr) return node->process;
  const auto comer = comers_.find(component);
  return comer == comers_.end() ? "" : comer->second;
}

Result<Member*> Operating::ready_member_of(const std::string& component) const {
  const std::string process = process_of(component);
  if (!process.empty()) return names_.ready_member(process);
  return gone(component);
}

Status Operating::are_ready(const std::vector<std::string>& components) const {
  std::set<std::string> errors;  // several components may be in one process
  for (const std::string& component : components)
    if (const Result<Member*> member = ready_member_of(component); !member)
      errors.insert(member.error().message);
  if (errors.empty()) return ok();
  return fail(Code::unavailable, joined(std::vector<std::string>(errors.begin(), errors.end()), "\n"));
}

// ---- Pauses

void Operating::suspend(const std::string& name, const ReplyPtr& reply) { pause(name, true, reply); }

void Operating::resume(const std::string& name, const ReplyPtr& reply) { pause(name, false, reply); }

void Operating::pause(const std::string& name, bool suspends, const ReplyPtr& reply) {
  Result<Nodes> nodes = names_.component_or_group(name);
  if (!nodes) return reply->refuse(nodes.error());
  if (const Status ready = are_ready(names_of(*nodes)); !ready.ok()) return reply->refuse(ready.error());
  if (suspends) std::ranges::reverse(*nodes);
  const bool is_group = graph_.find_group(name) != nullptr;
  std::vector<StateBefore> before;
  std::vector<JointStep> steps;
  for (const graph::ComponentNode* const node : *nodes) {
    const auto make = [&, component = node->name, process = node->process]() -> std::optional<ThereAndBack> {
      const host::ComponentState state = reports_(component).state;
      before.push_back({component, process, host::to_string(state)});
      if (is_group && host::is_suspended(state) == suspends) return std::nullopt;
      if (suspends) return ThereAndBack{Suspend{component}, Resume{component}};
      return ThereAndBack{Resume{component}, Suspend{component}};
    };
    steps.push_back({node->name, make, [](bool) {}});
  }
  if (const Status end = carry_out(steps); !end.ok()) return reply->refuse(end.error());
  log::info(kLogName, std::string("an operator has ") + (suspends ? "suspended " : "resumed ") + name);
  if (!is_group) return;
  for (const StateBefore& one : before)
    reply->add(Record{{"component", one.component},
                      {"process", one.process},
                      {"before", one.state},
                      {"now", host::to_string(reports_(one.component).state)}});
}

// ---- Parameters

// Returns what has parameters under a name: a component and the driver that it serves, or a driver alone.
Result<std::vector<Operating::Owner>> Operating::owners(const std::string& name) const {
  const graph::HardwareNode* hardware = graph_.find_hardware(name);
  std::vector<Owner> all;
  if (hardware == nullptr || graph_.find_component(name) != nullptr) {
    const Result<const graph::ComponentNode*> node = names_.component(name);
    if (!node) return node.error();
    all.push_back({name, present_.contract_of(name), nullptr, params_of(**node)});
    hardware = graph_.find_hardware((*node)->hardware);
  }
  if (hardware != nullptr)
    all.push_back({hardware->name, present_.contract_of(hardware->name), hardware,
                   present_.of(hardware->name, hardware->params)});
  return all;
}

// A component's name may hold no dot, so what follows the last one is a parameter.
Result<Operating::ParamName> Operating::find(const std::string& what) const {
  const std::size_t dot = what.rfind('.');
  const Result<std::vector<Owner>> all = owners(what.substr(0, dot));
  if (!all) return all.error();
  if (dot == std::string::npos) return ParamName{all->front(), ""};
  const std::string param = what.substr(dot + 1);
  std::vector<std::string> names;
  for (const Owner& owner : *all) {
    if (owner.params.contains(param)) return ParamName{owner, param};
    for (const auto& [name, value] : owner.params) names.push_back(name);
  }
  const auto nearest = xml::nearest_name(param, names);
  return fail(Code::not_found, all->front().name + " has no parameter " + in_quotes(param) +
                                   (nearest ? xml::did_you_mean(nearest) : "; it has: " + listed(names)));
}

graph::Params Operating::params_of(const graph::ComponentNode& component) const {
  return present_.of(component.name, component.params);
}

void Operating::get(const std::string& what, const ReplyPtr& reply) const {
  const auto add_param = [&](const Owner& owner, const std::string& name) {
    const ParamContract* const param = owner.contract == nullptr ? nullptr : owner.contract->param(name);
    reply->add(Record{{"component", owner.name},
                      {"param", name},
                      {"value", graph::print_value(owner.params.at(name))},
                      {"unit", param == nullptr ? "" : param->unit},
                      {"fixed", owner.hardware != nullptr || (param != nullptr && param->fixed)},
                      {"text", param == nullptr ? "" : param->text}});
  };
  const Result<ParamName> found = find(what);
  if (!found) return reply->refuse(found.error());
  if (!found->param.empty()) return add_param(found->owner, found->param);
  const Result<std::vector<Owner>> all = owners(what);
  for (const Owner& owner : *all)
    for (const auto& [param, value] : owner.params) add_param(owner, param);
}

void Operating::set(const std::vector<std::string>& words, const ReplyPtr& reply) {
  const Result<std::vector<Setting>> settings = SettingReader(*this).read(words);
  if (!settings) return reply->refuse(settings.error());
  if (const Status end = change(*settings); !end.ok()) reply->refuse(end.error());
}

Status Operating::change(const std::map<std::string, graph::Params>& wanted) {
  std::vector<Setting> settings;
  for (const auto& [name, values] : wanted) settings.push_back({name, graph::print_values(values), values});
  return change(settings);
}

Status Operating::change(const std::vector<Setting>& settings, const std::string& who) {
  std::vector<std::string> components;
  std::vector<JointStep> steps;
  for (const Setting& setting : settings) {
    components.push_back(setting.component);
    steps.push_back(step_of(setting));
  }
  if (Status ready = are_ready(components); !ready.ok()) return ready;
  if (Status end = carry_out(steps); !end.ok()) return end;
  for (const Setting& setting : settings)
    for (const auto& [param, value] : setting.values)
      log::info(setting.component, who + " has set " + param + " to " + graph::print_value(value));
  return ok();
}

Result<std::string> Operating::set_for(const std::string& by, const PeerOrder& order) {
  const std::string& component = order.component;
  const Contract* const contract = present_.contract_of(component);
  if (graph_.find_component(component) == nullptr || contract == nullptr) return gone(component);
  const Result<graph::Params> read = graph::read_settings(contract->params, {{order.param, order.value}});
  if (!read) return read.error();
  const Setting setting{component, {{order.param, order.value}}, *read};
  const Status end = change({setting}, by);
  if (!end.ok()) return end.error();
  return graph::print_value(setting.before->at(order.param));
}

// Returns the present values of what is to change. Since the order was given, the component may have gone or got another
// type.
Result<graph::Params> Operating::present_of(const Setting& setting) const {
  const graph::ComponentNode* const node = graph_.find_component(setting.component);
  if (node == nullptr) return gone(setting.component);
  const graph::Params all = params_of(*node);
  graph::Params present;
  for (const auto& [param, value] : setting.values) {
    const auto known = all.find(param);
    if (known == all.end())
      return fail(Code::not_found,
                  "it is of another type now, without a parameter " + in_quotes(param) + "; orcactl get " +
                      node->name + " shows those that it has",
                  node->name);
    present.insert(*known);
  }
  return present;
}

JointStep Operating::step_of(const Setting& setting) {
  const auto make = [this, setting]() -> Result<std::optional<ThereAndBack>> {
    Result<graph::Params> present = present_of(setting);
    if (!present) return present.error();
    *setting.before = std::move(present).value();
    const std::string& name = setting.component;
    return std::optional(ThereAndBack{SetParams{name, {setting.texts.begin(), setting.texts.end()}},
                                      SetParams{name, pairs_of(*setting.before)}});
  };
  const auto obeyed = [this, setting](bool has_gone) {
    for (const auto& [param, value] : has_gone ? setting.values : *setting.before)
      present_.set(setting.component, param, value);
  };
  return {setting.component, make, obeyed};
}

// ---- The run

void Operating::restart(const std::string& name, const ReplyPtr& reply) {
  const Result<Member*> member = names_.process(name);
  if (!member) return reply->refuse(member.error());
  log::info(kLogName, "an operator restarts process " + (*member)->name());
  if (const Status begun = levers_.restart(**member); !begun.ok()) return reply->refuse(begun.error());
  const auto is_back = [&process = **member, start = (*member)->starts().count] {
    return process.phase() == Member::Phase::up && process.starts().count > start;
  };
  if (conductor_.wait(is_back))
    reply->add(Record{{"process", (*member)->name()}, {"restarts", (*member)->restarts()}});
}

void Operating::stop(const ReplyPtr& reply) {
  log::info(kLogName, "an operator ends the run");
  until_end_.push_back(reply);
  levers_.stop();
}

void Operating::recall(const std::vector<std::pair<std::string, Pairs>>& params) {
  for (const auto& [component, values] : params) {
    const Contract* const contract = present_.contract_of(component);
    if (contract == nullptr) continue;
    const Result<graph::Params> read = graph::read_settings(contract->params, {values.begin(), values.end()});
    if (!read) continue;
    for (const auto& [param, value] : *read) present_.set(component, param, value);
  }
}

void Operating::came_up(const std::vector<Member*>& members) {
  for (const Member* const member : members) {
    for (const graph::ComponentNode& node : graph_.components)
      if (node.process == member->name()) present_.forget(node.name);
    for (const graph::HardwareNode& node : graph_.hardware)
      if (node.process == member->name()) present_.forget(node.name);
  }
}

}  // namespace orca::supervisor
