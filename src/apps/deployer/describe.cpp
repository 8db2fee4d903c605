// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "describe.hpp"

#include <filesystem>
#include <iomanip>
#include <sstream>

#include "orca/base/text.hpp"
#include "orca/plugin/describe.hpp"
#include "orca/plugin/library.hpp"
#include "orca/xml/number.hpp"

namespace orca::deployer {
namespace {

std::string text_of(const ParamValue& value) {
  struct Visitor {
    std::string operator()(bool b) const { return b ? "true" : "false"; }
    std::string operator()(std::int64_t i) const { return std::to_string(i); }
    std::string operator()(double d) const { return xml::number_text(d); }
    std::string operator()(const std::string& s) const { return in_quotes(s); }
    std::string operator()(const std::vector<std::string>& list) const {
      return in_quotes(joined(list, "; "));
    }
  };
  return std::visit(Visitor{}, value);
}

std::string queue_text(const PortContract& port) {
  if (port.pattern == Pattern::query || (port.pattern == Pattern::push) == (port.role == Role::server))
    return {};
  const bool drops_oldest = port.queue.overflow == QueuePolicy::Overflow::drop_oldest;
  if (port.queue.depth == 1 && drops_oldest) return ", the latest";
  return ", queue of " + std::to_string(port.queue.depth) + " (" + to_string(port.queue.overflow) + ")";
}

std::string type_text(const TypeId& type) {
  std::ostringstream out;
  out << type.name << "#" << std::hex << std::setw(16) << std::setfill('0') << type.hash;
  return out.str();
}

void write_port(std::ostream& out, const PortContract& port) {
  out << "    " << port.name << (port.many ? "[]" : "") << "  " << to_string(port.pattern)
      << to_string(port.role) << " of " << type_text(port.type);
  if (port.reply) out << " -> " << type_text(*port.reply);
  if (port.role == Role::proxy) out << (port.required ? ", required" : ", optional");
  out << queue_text(port) << (port.text.empty() ? "" : ": " + port.text) << "\n";
}

void write_param(std::ostream& out, const ParamContract& param) {
  const std::string unit = param.unit.empty() ? "" : " " + param.unit;
  out << "    " << param.name << " = " << text_of(param.default_value) << unit << "  ("
      << to_string(param.type);
  if (param.min) out << ", from " << xml::number_text(*param.min) << unit;
  if (param.max) out << ", to " << xml::number_text(*param.max) << unit;
  for (const std::string& choice : param.choices)
    out << (&choice == &param.choices.front() ? ", one of " : " | ") << choice;
  out << (param.file ? ", a file" : "") << (param.fixed ? ", fixed while it runs" : "") << ")"
      << (param.text.empty() ? "" : ": " + param.text) << "\n";
}

void write_trigger(std::ostream& out, const Contract& contract) {
  const Trigger& trigger = contract.default_trigger;
  if (trigger.kind == Trigger::Kind::period)
    out << "  a lap every " << xml::number_text(to_seconds(trigger.period)) << " s\n";
  if (!trigger.waits_for_ports()) return;
  out << (trigger.kind == Trigger::Kind::on_all ? "  a lap for new objects on all of "
                                                : "  a lap for each object on ")
      << joined(trigger.ports, ", ");
  if (trigger.period > Duration{0})
    out << ", at least every " << xml::number_text(to_seconds(trigger.period)) << " s";
  out << "\n";
}

void write_contract(std::ostream& out, const Contract& contract) {
  out << contract.type << "  (" << (contract.kind == PluginKind::component ? "component" : "hardware") << ", "
      << contract.library << ")\n";
  write_trigger(out, contract);
  if (contract.needs_hardware) out << "  wraps hardware: more ports come from what the graph binds to it\n";
  if (!contract.ports.empty()) out << "  ports\n";
  for (const PortContract& port : contract.ports) write_port(out, port);
  if (!contract.params.empty()) out << "  parameters\n";
  for (const ParamContract& param : contract.params) write_param(out, param);
}

Result<Contract> contract_of(const TypeEntry& type, const std::string& path) {
  if (type.kind == PluginKind::component) return plugin::describe_component(type, path, nullptr);
  const auto hardware = plugin::describe_hardware(type, path, type.type);
  if (!hardware) return hardware.error();
  return (*hardware)->contract();
}

}  // namespace

Result<PluginDescription> describe_plugin(const std::string& path, const std::string& type) {
  // The path has a folder, so that the system's loader takes this file and does not search.
  const Result<std::unique_ptr<plugin::PluginLibrary>> library =
      plugin::PluginLibrary::load(std::filesystem::absolute(path).string());
  if (!library) return library.error();
  const Manifest& manifest = (*library)->manifest();
  PluginDescription plugin{path, manifest.abi_version, manifest.build_id, (*library)->build_id(), {}};
  for (const TypeEntry* entry : (*library)->types()) {
    if (!type.empty() && entry->type != type) continue;
    Result<Contract> contract = contract_of(*entry, path);
    if (!contract) return contract.error();
    plugin.types.push_back(*std::move(contract));
  }
  if (plugin.types.empty() && !type.empty())
    return fail(Code::not_found, "the plugin " + path + " does not hold the type " + in_quotes(type) +
                                     ", which is listed beside it; build the plugin again");
  return plugin;
}

bool names_plugin_file(const std::string& word) {
  return word.find('/') != std::string::npos || word.ends_with(".so") || std::filesystem::exists(word);
}

std::string text(const PluginDescription& plugin) {
  std::ostringstream out;
  out << plugin.file << ": plugin for ABI version " << plugin.abi_version << ", built with Orca "
      << plugin.orca_version << (plugin.build_id.empty() ? "" : ", build id " + plugin.build_id) << "\n\n";
  for (const Contract& contract : plugin.types) write_contract(out, contract);
  return out.str();
}

}  // namespace orca::deployer
