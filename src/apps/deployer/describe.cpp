// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "describe.hpp"

#include <filesystem>
#include <sstream>

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
    std::string operator()(const std::string& s) const { return "\"" + s + "\""; }
    std::string operator()(const std::vector<std::string>& list) const {
      std::string joined;
      for (const std::string& item : list) joined += (joined.empty() ? "" : "; ") + item;
      return "\"" + joined + "\"";
    }
  };
  return std::visit(Visitor{}, value);
}

void write_port(std::ostream& out, const PortContract& port) {
  out << "    " << port.name << (port.many ? "[]" : "") << "  " << to_string(port.pattern)
      << to_string(port.role) << " of " << port.type.name;
  if (port.reply) out << " -> " << port.reply->name;
  if (port.role == Role::proxy) out << (port.required ? ", required" : ", optional");
  out << (port.text.empty() ? "" : ": " + port.text) << "\n";
}

void write_param(std::ostream& out, const ParamContract& param) {
  const std::string unit = param.unit.empty() ? "" : " " + param.unit;
  out << "    " << param.name << " = " << text_of(param.default_value) << unit << "  ("
      << to_string(param.type);
  if (param.min) out << ", from " << xml::number_text(*param.min) << unit;
  if (param.max) out << ", to " << xml::number_text(*param.max) << unit;
  for (const std::string& choice : param.choices)
    out << (&choice == &param.choices.front() ? ", one of " : " | ") << choice;
  out << ")" << (param.text.empty() ? "" : ": " + param.text) << "\n";
}

void write_contract(std::ostream& out, const Contract& contract) {
  out << contract.type << "  (" << (contract.kind == PluginKind::component ? "component" : "hardware") << ", "
      << contract.library << ")\n";
  if (contract.needs_hardware) out << "  wraps hardware: more ports come from what the graph binds to it\n";
  if (!contract.ports.empty()) out << "  ports\n";
  for (const PortContract& port : contract.ports) write_port(out, port);
  if (!contract.params.empty()) out << "  parameters\n";
  for (const ParamContract& param : contract.params) write_param(out, param);
}

}  // namespace

Result<std::string> describe_plugin(const std::string& path) {
  // With a folder in its name, so that the system's loader takes this file and does not search.
  const Result<std::unique_ptr<PluginLibrary>> library =
      PluginLibrary::load(std::filesystem::absolute(path).string());
  if (!library) return library.error();
  std::ostringstream out;
  for (const TypeEntry* type : (*library)->types()) {
    if (type->kind == PluginKind::component) {
      const Result<Contract> contract = describe_component(*type, path, nullptr);
      if (!contract) return contract.error();
      write_contract(out, *contract);
    } else {
      const auto hardware = describe_hardware(*type, path, type->type);
      if (!hardware) return hardware.error();
      write_contract(out, (*hardware)->contract());
    }
  }
  return out.str();
}

}  // namespace orca::deployer
