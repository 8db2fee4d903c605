// SPDX-License-Identifier: LGPL-3.0-or-later
#include "types.hpp"

#include <utility>

#include "reading/codes.hpp"
#include "reading/naming.hpp"

namespace orca::graph {

const Text* Types::type_of(const Node& node) {
  const Text* type = node.find("type");
  if (type == nullptr) {
    report_.error(codes::kMissingAttribute, node.position,
                  "<" + std::string(node.rule->name) + "> needs the attribute \"type\", for " + node.title());
  }
  return type != nullptr && type->known ? type : nullptr;
}

std::optional<Contract> Types::hardware(const Node& node) {
  const Text* type = type_of(node);
  if (type == nullptr) return std::nullopt;
  Result<Contract> contract = catalogue_.hardware(type->value);
  if (contract) report_unfit(node, type->value, PluginKind::hardware);
  if (contract) return *std::move(contract);
  report_failure(node, contract.error(), PluginKind::hardware);
  return std::nullopt;
}

Result<std::shared_ptr<const Contract>> Types::ask(const std::string& type, const HardwareUse* use) {
  const auto known = without_hardware_.find(type);
  if (use == nullptr && known != without_hardware_.end()) return known->second;
  Result<Contract> contract = catalogue_.component(type, use);
  if (!contract) return contract.error();
  auto shared = std::make_shared<const Contract>(*std::move(contract));
  if (use == nullptr) without_hardware_.emplace(type, shared);
  return Result<std::shared_ptr<const Contract>>(std::move(shared));
}

std::shared_ptr<const Contract> Types::component(const Node& node, const HardwareUse* use) {
  const Text* type = type_of(node);
  if (type == nullptr) return nullptr;
  Result<std::shared_ptr<const Contract>> contract = ask(type->value, use);
  if (contract) report_unfit(node, type->value, PluginKind::component);
  if (contract) return *std::move(contract);
  report_failure(node, contract.error(), PluginKind::component);
  return nullptr;
}

std::shared_ptr<const Contract> Types::component_without_hardware(const Node& node) {
  const Text* type = type_of(node);
  if (type == nullptr) return nullptr;
  Result<std::shared_ptr<const Contract>> contract = ask(type->value, nullptr);
  if (contract) report_unfit(node, type->value, PluginKind::component);
  if (contract) return *std::move(contract);
  if (contract.error().code == Code::not_found) report_failure(node, contract.error(), PluginKind::component);
  return nullptr;
}

void Types::report_failure(const Node& node, const Error& error, PluginKind kind) {
  const std::string what = node.title() + ": " + error.text();
  if (error.code == Code::not_found) {
    // The index knows a type that cannot be found any more: its plugin is gone.
    std::vector<std::string> names = catalogue_.type_names(kind);
    std::erase(names, node.value("type"));
    return report_.error(codes::kUnknownType, node.place("type"),
                         what + report_.hint(node.value("type"), names));
  }
  if (broken_.insert(error.text()).second) report_.error(codes::kPlugin, node.place("type"), what);
}

void Types::report_unfit(const Node& node, const std::string& type, PluginKind kind) {
  if (!unfit_.insert(type).second) return;
  for (const std::string& reason : catalogue_.unfit(kind, type))
    report_.error(codes::kUnfit, node.place("type"), node.title() + ": " + type + " " + reason);
}

}  // namespace orca::graph
