// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/operating.hpp"

#include <utility>

#include "orca/base/log.hpp"
#include "orca/base/text.hpp"
#include "orca/graph/print.hpp"
#include "orca/graph/settings.hpp"
#include "orca/supervisor/log_name.hpp"
#include "orca/xml/names.hpp"

namespace orca::supervisor {
namespace {

Member::Answered pass_on(const ReplyPtr& reply) {
  return [reply](const Status& outcome) {
    if (!outcome.ok()) reply->refuse(outcome.error());
  };
}

}  // namespace

void Operating::order(const std::string& component, const ReplyPtr& reply,
                      const std::function<Order(const std::string&)>& make) {
  const Result<const graph::ComponentNode*> node = names_.component(component);
  if (!node) return reply->refuse(node.error());
  const Result<Member*> member = names_.ready_member_of(**node);
  if (!member) return reply->refuse(member.error());
  (*member)->ask(make(component), pass_on(reply));
}

void Operating::suspend(const std::string& component, const ReplyPtr& reply) {
  order(component, reply, [](const std::string& name) { return Suspend{name}; });
}

void Operating::resume(const std::string& component, const ReplyPtr& reply) {
  order(component, reply, [](const std::string& name) { return Resume{name}; });
}

// A component's name may hold no dot, so what follows the last one is a parameter.
Result<Operating::ParamName> Operating::find(const std::string& what) const {
  const std::size_t dot = what.rfind('.');
  const Result<const graph::ComponentNode*> node = names_.component(what.substr(0, dot));
  if (!node) return node.error();
  if (dot == std::string::npos) return ParamName{*node, ""};
  const std::string param = what.substr(dot + 1);
  if ((*node)->params.contains(param)) return ParamName{*node, param};
  std::vector<std::string> names;
  for (const auto& [name, value] : (*node)->params) names.push_back(name);
  const auto nearest = xml::nearest_name(param, names);
  return fail(Code::not_found, (*node)->name + " has no parameter " + in_quotes(param) +
                                   (nearest ? xml::did_you_mean(nearest) : "; it has: " + listed(names)));
}

std::string Operating::value_of(const ParamName& name) const {
  return graph::print_value(params_of(*name.component).at(name.param));
}

graph::Params Operating::params_of(const graph::ComponentNode& component) const {
  graph::Params params = component.params;
  const auto changed = changed_.find(component.name);
  if (changed == changed_.end()) return params;
  for (const auto& [name, value] : changed->second) params.insert_or_assign(name, value);
  return params;
}

void Operating::add_param(const ParamName& name, Reply& reply) const {
  const auto contract = facts_.contracts.find(name.component->name);
  const ParamContract* const param =
      contract == facts_.contracts.end() ? nullptr : contract->second.param(name.param);
  reply.add(Record{{"component", name.component->name},
                   {"param", name.param},
                   {"value", value_of(name)},
                   {"unit", param == nullptr ? "" : param->unit},
                   {"fixed", param != nullptr && param->fixed},
                   {"text", param == nullptr ? "" : param->text}});
}

void Operating::get(const std::string& what, const ReplyPtr& reply) const {
  const Result<ParamName> name = find(what);
  if (!name) return reply->refuse(name.error());
  if (!name->param.empty()) return add_param(*name, *reply);
  for (const auto& [param, value] : name->component->params) add_param({name->component, param}, *reply);
}

void Operating::set(const std::string& what, const std::string& value, const ReplyPtr& reply) {
  const Result<ParamName> name = find(what);
  if (!name) return reply->refuse(name.error());
  const std::string component = name->component->name;
  const auto contract = facts_.contracts.find(component);
  if (name->param.empty() || contract == facts_.contracts.end())
    return reply->refuse(fail(Code::invalid_argument, "name one parameter: " + component + ".PARAM"));
  const Result<graph::Params> read = graph::read_settings(contract->second.params, {{name->param, value}});
  if (!read) return reply->refuse(read.error());
  const Result<Member*> member = names_.ready_member_of(*name->component);
  if (!member) return reply->refuse(member.error());
  (*member)->ask(SetParams{component, {{name->param, value}}}, [this, component, reply,
                                                                values = *read](const Status& outcome) {
    if (!outcome.ok()) return reply->refuse(outcome.error());
    for (const auto& [param, changed] : values) {
      changed_[component].insert_or_assign(param, changed);
      log::info(component, "an operator has set " + param + " to " + graph::print_value(changed));
    }
  });
}

void Operating::restart(const std::string& name, const ReplyPtr& reply) {
  const Result<Member*> member = names_.process(name);
  if (!member) return reply->refuse(member.error());
  log::info(kLogName, "an operator restarts process " + (*member)->name());
  if (const Status begun = levers_.restart(**member); !begun.ok()) return reply->refuse(begun.error());
  awaited_.emplace(*member, reply);
}

void Operating::stop(const ReplyPtr& reply) {
  log::info(kLogName, "an operator ends the run");
  until_end_.push_back(reply);
  levers_.stop();
}

void Operating::recall(const std::vector<std::pair<std::string, Pairs>>& params) {
  for (const auto& [component, values] : params) {
    const auto contract = facts_.contracts.find(component);
    if (contract == facts_.contracts.end()) continue;
    const Result<graph::Params> read =
        graph::read_settings(contract->second.params, {values.begin(), values.end()});
    if (!read) continue;
    for (const auto& [param, value] : *read) changed_[component].insert_or_assign(param, value);
  }
}

void Operating::came_up(const std::vector<Member*>& members) {
  for (const Member* const member : members) {
    for (const graph::ComponentNode& node : graph_.components)
      if (node.process == member->name()) changed_.erase(node.name);
    const auto [begin, end] = awaited_.equal_range(member);
    for (auto waiting = begin; waiting != end; ++waiting)
      waiting->second->add(Record{{"process", member->name()}, {"restarts", member->restarts()}});
    awaited_.erase(begin, end);
  }
}

}  // namespace orca::supervisor
