// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/params/present_params.hpp"

#include <utility>

namespace orca::supervisor {
namespace {

template <class Value>
const Value* in(const std::map<std::string, Value>& all, const std::string& name) {
  const auto found = all.find(name);
  return found == all.end() ? nullptr : &found->second;
}

}  // namespace

const Contract* PresentParams::contract_of(const std::string& owner) const {
  if (const Exchanged* const exchanged = in(exchanged_, owner)) return &exchanged->contract;
  return in(graph_.find_component(owner) != nullptr ? facts_.contracts : facts_.drivers, owner);
}

graph::Params PresentParams::of(const std::string& owner, graph::Params in_graph) const {
  const Exchanged* const exchanged = in(exchanged_, owner);
  graph::Params values = exchanged != nullptr ? exchanged->values : std::move(in_graph);
  if (const graph::Params* const changed = in(changed_, owner))
    for (const auto& [name, value] : *changed) values.insert_or_assign(name, value);
  return values;
}

std::string PresentParams::plugin_of(const graph::HardwareNode& hardware) const {
  if (const Exchanged* const exchanged = in(exchanged_, hardware.name)) return exchanged->file;
  const PluginFacts* const plugin = in(facts_.plugins, hardware.type);
  return plugin == nullptr ? "PLUGIN.so" : plugin->file;
}

void PresentParams::add_names(Reply& reply) const {
  for (const graph::ComponentNode& node : graph_.components)
    for (const auto& [name, value] : of(node.name, node.params))
      reply.add(Record{{"param", node.name + "." + name}});
}

void PresentParams::note(const ExchangedCode& code) {
  Exchanged exchanged{{}, {code.values.begin(), code.values.end()}, code.file};
  exchanged.contract.params = code.params;
  for (const ParamContract& param : code.params) exchanged.values.emplace(param.name, param.default_value);
  exchanged_.insert_or_assign(code.component, std::move(exchanged));
  changed_.erase(code.component);  // its values have what was changed
}

void PresentParams::set(const std::string& owner, const std::string& param, const ParamValue& value) {
  changed_[owner].insert_or_assign(param, value);
}

void PresentParams::forget(const std::string& owner) {
  exchanged_.erase(owner);
  changed_.erase(owner);
}

void PresentParams::forget_changes() {
  std::erase_if(changed_, [this](const auto& one) { return !exchanged_.contains(one.first); });
}

}  // namespace orca::supervisor
