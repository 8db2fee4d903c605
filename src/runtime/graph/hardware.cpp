// SPDX-License-Identifier: LGPL-3.0-or-later
#include "checks.hpp"
#include "parameters.hpp"

namespace orca::graph {
namespace {

CheckedHardware check_one(const Node& node, Types& types, Report& report) {
  CheckedHardware checked;
  checked.value = {node.value("name"), node.value("type"), {}, node.position};
  check_name(node, "name", report);
  const std::optional<Contract> contract = types.hardware(node);
  if (!contract) return checked;
  auto params = read_params(node, *contract, report);
  if (!params) return checked;
  checked.value.params = std::move(*params);
  const HardwareUse use{checked.value.name, checked.value.type, checked.value.params};
  const std::vector<std::string> faults = types.catalogue().validate_hardware(use);
  for (const std::string& line : faults) report.line(node.position, line);
  checked.sound = faults.empty();
  return checked;
}

}  // namespace

void check_hardware(const std::vector<Node>& nodes, Types& types, Model& model, Report& report) {
  for (const Node& node : nodes) {
    model.add(check_one(node, types, report), !node.value("name").empty() && !node.duplicate);
  }
}

}  // namespace orca::graph
