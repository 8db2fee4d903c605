// SPDX-License-Identifier: LGPL-3.0-or-later
#include "checking/checks.hpp"

#include <algorithm>

#include "orca/base/text.hpp"
#include "reading/codes.hpp"
#include "reading/parameters.hpp"
#include "reading/values.hpp"

namespace orca::graph {
namespace {

void report_fault(const Node& node, const HardwareFault& fault, Report& report) {
  if (fault.param.empty()) {
    report.line(node.position, fault.text);
    return;
  }
  const std::string text = node.title() + ": parameter " + in_quotes(fault.param) + ": " + fault.text;
  if (fault.only_warns) {
    report.warning(codes::kHardwareDoubts, place_of_param(node, fault.param), text);
  } else {
    report.error(codes::kHardwareRefuses, place_of_param(node, fault.param), text);
  }
}

// Returns whether the hardware complains about a default that stands for a value which could not be read.
bool follows_from(const std::set<std::string>& unread, const HardwareFault& fault) {
  return unread.contains(fault.param) ||
         std::ranges::any_of(fault.follows_from,
                             [&](const std::string& param) { return unread.contains(param); });
}

HardwareUse use_of(const CheckedHardware& checked) {
  return {checked.value.name, checked.value.type, checked.value.params};
}

CheckedHardware check_one(const Node& node, Types& types, Report& report) {
  CheckedHardware checked;
  checked.value.name = node.value("name");
  checked.value.type = node.value("type");
  checked.value.position = node.position;
  check_name(node, "name", report);
  const std::optional<Contract> contract = types.hardware(node);
  if (!contract) return checked;
  ReadParams params = read_params(node, *contract, report);
  checked.value.params = std::move(params.values);
  checked.value.here = std::move(params.here);
  const std::vector<HardwareFault> faults = types.catalogue().validate_hardware(use_of(checked));
  for (const HardwareFault& fault : faults)
    if (!follows_from(params.unread, fault)) report_fault(node, fault, report);
  checked.sound = params.sound() && std::ranges::all_of(faults, &HardwareFault::only_warns);
  return checked;
}

// A hardware container without an error of its own, and its node.
struct Sound {
  const Node* node;
  HardwareUse use;
};

// Each container is compared with all before it, so there is a limit to their number. Beyond it, the start of the
// system finds what is left.
constexpr std::size_t kMostCompared = 1000;

// Reports what the two cannot have both, and notes what they cannot have in different processes.
void compare(const Sound& later, const Sound& earlier, Catalogue& catalogue, Model& model, Report& report) {
  for (HardwareFault& fault : catalogue.hardware_conflicts(later.use, earlier.use)) {
    if (fault.if_apart) {
      model.shared.push_back({later.node, earlier.use.name, std::move(fault)});
    } else {
      report_fault(*later.node, fault, report);
    }
  }
}

void check_conflicts(const std::vector<Sound>& all, Catalogue& catalogue, Model& model, Report& report) {
  for (std::size_t i = 0; i < std::min(all.size(), kMostCompared); ++i)
    for (std::size_t k = 0; k < i; ++k) compare(all[i], all[k], catalogue, model, report);
}

}  // namespace

void check_hardware(const std::vector<Node>& nodes, Types& types, Model& model, Report& report) {
  std::vector<Sound> sound;
  for (const Node& node : nodes) {
    const bool by_name = !node.value("name").empty() && !node.duplicate;
    CheckedHardware checked = check_one(node, types, report);
    if (checked.sound && by_name) sound.push_back({&node, use_of(checked)});
    model.add(std::move(checked), by_name);
  }
  check_conflicts(sound, types.catalogue(), model, report);
  check_emulated_lines(nodes, model, report);
}

}  // namespace orca::graph
