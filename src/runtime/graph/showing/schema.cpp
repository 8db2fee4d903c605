// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/xml/schema.hpp"

#include <map>
#include <string>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/graph/print.hpp"
#include "orca/xml/number.hpp"
#include "reading/rules.hpp"

namespace orca::graph {
namespace {

using xml::SchemaWord;
using xml::Vocabulary;

const char* element_of(PluginKind kind) { return kind == PluginKind::component ? "component" : "hardware"; }

std::string port_text(const PortContract& port) {
  std::string text = to_string(port.pattern) + std::string(to_string(port.role)) + " of " + port.type.name;
  if (port.reply) text += " -> " + port.reply->name;
  if (port.many) text += ", any number";
  if (port.required) text += ", required";
  return text + (port.text.empty() ? "" : ": " + port.text);
}

std::string param_text(const ParamContract& param) {
  const std::string unit = param.unit.empty() ? "" : " " + param.unit;
  std::string text = param.text + (param.text.empty() ? "" : " ") + "(";
  text += param.choices.empty() ? to_string(param.type) : joined(param.choices, " | ");
  if (param.min) text += ", from " + xml::number_text(*param.min) + unit;
  if (param.max) text += ", to " + xml::number_text(*param.max) + unit;
  if (!param.min && !param.max && !unit.empty()) text += " in" + unit;
  const std::string otherwise = print_value(param.default_value);
  if (!otherwise.empty()) text += "; " + otherwise + unit + " if not given";
  return text + (param.fixed ? "; fixed while it runs" : "") + ")";
}

std::string type_text(const Contract& contract) {
  std::string text = "In " + contract.library + ".";
  if (contract.needs_hardware) text += " Wraps hardware, from which more ports come.";
  for (const PortContract& port : contract.ports) text += "\nport " + port.name + ": " + port_text(port);
  for (const ParamContract& param : contract.params)
    text += "\nparam " + param.name + ": " + param_text(param);
  return text;
}

// Names that types have in common, and what each type says of it, a line each.
using Names = std::map<std::string, std::string>;

void add_line(Names& names, const std::string& name, const std::string& type, const std::string& text) {
  std::string& lines = names[name];
  lines += (lines.empty() ? "" : "\n") + type + ": " + text;
}

std::vector<SchemaWord> words_of(const Names& names) {
  std::vector<SchemaWord> words;
  for (const auto& [name, text] : names) words.push_back({name, text});
  return words;
}

// Adds the types of one kind, and their parameters and ports.
void add_types(std::span<const Contract> contracts, PluginKind kind, std::vector<Vocabulary>& vocabularies) {
  Names types;
  Names params;
  Names ports;
  for (const Contract& contract : contracts) {
    if (contract.kind != kind) continue;
    types[contract.type] = type_text(contract);
    for (const ParamContract& param : contract.params)
      add_line(params, param.name, contract.type, param_text(param));
    for (const PortContract& port : contract.ports)
      add_line(ports, port.name, contract.type, port_text(port));
  }
  vocabularies.push_back({element_of(kind), "", "type", words_of(types)});
  vocabularies.push_back({"param", element_of(kind), "name", words_of(params)});
  // Ports that come from hardware are not known before both are chosen.
  if (kind == PluginKind::component)
    vocabularies.push_back({"port", element_of(kind), "name", words_of(ports), false});
}

}  // namespace

std::string schema(std::span<const Contract> types, xml::SchemaLanguage language) {
  xml::SchemaOptions options{.title = "Orca's system graphs", .has_arguments = true};
  options.vocabularies = {{"connect", "", "queue", {{"latest", "Only the newest waits."}}, false},
                          {"connect", "", "drop_limit", {{"any", "Never logged."}}, false}};
  if (!types.empty())
    for (const PluginKind kind : {PluginKind::component, PluginKind::hardware})
      add_types(types, kind, options.vocabularies);
  options.unique = {{"graph", "machine"},   {"graph", "process"},  {"graph", "arg"},
                    {"graph", "component"}, {"graph", "hardware"}, {"component", "param"},
                    {"component", "port"},  {"hardware", "param"}};
  return xml::schema(graph_rules(), options, language);
}

}  // namespace orca::graph
