// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include <variant>

#include "describe.hpp"
#include "orca/base/json.hpp"

namespace orca::deployer {
namespace {

void write(const TypeId& type, JsonWriter& json) {
  json.begin_object();
  json.member("name", type.name);
  json.member("hash", type.hash);
  json.member("layout", type.layout);
  json.end();
}

void write(const PortContract& port, JsonWriter& json) {
  json.begin_object();
  json.member("name", port.name);
  json.member("pattern", to_string(port.pattern));
  json.member("role", to_string(port.role));
  write(port.type, json.key("type"));
  if (port.reply) write(*port.reply, json.key("reply"));
  json.member("required", port.required);
  json.member("many", port.many);
  json.member("queue", port.queue.depth);
  json.member("overflow", to_string(port.queue.overflow));
  json.member("text", port.text);
  json.end();
}

void write(const ParamContract& param, JsonWriter& json) {
  json.begin_object();
  json.member("name", param.name);
  json.member("type", to_string(param.type));
  json.member("unit", param.unit);
  std::visit([&](const auto& value) { json.member("default", value); }, param.default_value);
  if (param.min) json.member("min", *param.min);
  if (param.max) json.member("max", *param.max);
  if (!param.choices.empty()) json.member("choices", param.choices);
  json.member("file", param.file);
  json.member("fixed", param.fixed);
  json.member("text", param.text);
  json.end();
}

void write(const Trigger& trigger, JsonWriter& json) {
  if (trigger.kind == Trigger::Kind::period) json.member("period", to_seconds(trigger.period));
  if (!trigger.waits_for_ports()) return;
  json.member("on", trigger.ports);
  json.member("fuse", trigger.kind == Trigger::Kind::on_all ? "all" : "any");
  if (trigger.period > Duration{0}) json.member("at_least_every", to_seconds(trigger.period));
}

void write(const Contract& contract, JsonWriter& json) {
  json.begin_object();
  json.member("type", contract.type);
  json.member("kind", contract.kind == PluginKind::component ? "component" : "hardware");
  json.member("needs_hardware", contract.needs_hardware);
  write(contract.default_trigger, json);
  json.key("ports").begin_array();
  for (const PortContract& port : contract.ports) write(port, json);
  json.end();
  json.key("parameters").begin_array();
  for (const ParamContract& param : contract.params) write(param, json);
  json.end();
  json.end();
}

}  // namespace

std::string json(const PluginDescription& plugin) {
  JsonWriter json;
  json.begin_object();
  json.member("file", plugin.file);
  json.member("abi_version", plugin.abi_version);
  json.member("orca_version", plugin.orca_version);
  json.member("build_id", plugin.build_id);
  json.key("types").begin_array();
  for (const Contract& contract : plugin.types) write(contract, json);
  json.end();
  json.end();
  return json.text();
}

}  // namespace orca::deployer
