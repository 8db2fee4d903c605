// SPDX-License-Identifier: LGPL-3.0-or-later
#include "checking/checks.hpp"

#include <map>
#include <set>
#include <string>

#include "orca/base/text.hpp"
#include "reading/codes.hpp"
#include "reading/parameters.hpp"

namespace orca::graph {
namespace {

class Placement {
 public:
  Placement(Model& model, Report& report) : model_(model), report_(report) {}

  // Puts a component into the process that it names.
  void place(const Node& node, CheckedComponent& component) {
    const Text* name = node.find("process");
    if (name == nullptr || (name->known && name->value.empty())) return;
    component.process_known = name->known && check_exists(node, *name);
    if (component.process_known) component.value.process = name->value;
  }

  // Puts hardware into the process of its first component, and reports components in another one.
  void join(const CheckedComponent& component) {
    const auto found = model_.hardware_by_name.find(component.value.hardware);
    if (found == model_.hardware_by_name.end() || component.duplicate || !component.process_known) return;
    CheckedHardware& hardware = model_.hardware[found->second];
    const auto [decider, fresh] = deciders_.try_emplace(&hardware, &component);
    if (fresh) hardware.value.process = component.value.process;
    if (component.value.process != hardware.value.process)
      report_apart(component, hardware, *decider->second);
  }

  // Reports that parts are in "main", if the graph declares machines and does not say on which of them it runs.
  void check_machine_of_main() {
    const auto in_main = [&](const auto& node) {
      return model_.find_process(node.process) == &model_.implicit_main;
    };
    if (model_.implicit_main.placed) return;
    if (model_.parts_missing || model_.excused.contains(kMainProcess)) return;  // it may be declared there
    for (const CheckedComponent& component : model_.components)
      if (component.process_known && in_main(component.value)) return report_main(component.value);
    for (const CheckedHardware& hardware : model_.hardware)
      if (in_main(hardware.value)) return report_main(hardware.value);
  }

  // Reports hardware that must share a process and does not, once for each.
  void check_shared() {
    std::set<const Node*> reported;
    for (const SharedThing& shared : model_.shared) {
      const CheckedHardware& later = *model_.find_hardware(shared.node->value("name"));
      const CheckedHardware& earlier = *model_.find_hardware(shared.earlier);
      if (later.value.process == earlier.value.process || !reported.insert(shared.node).second) continue;
      report_.error(codes::kSplit, place_of_param(*shared.node, shared.fault.param),
                    shared.node->title() + ": parameter " + in_quotes(shared.fault.param) + ": " +
                        shared.fault.text + "; " + whereabouts(later.value) + ", " +
                        whereabouts(earlier.value) + "; put both into one process");
    }
  }

 private:
  template <class Part>
  void report_main(const Part& node) {
    report_.error(codes::kNoMachine, node.position,
                  in_quotes(node.name) +
                      " is in the process \"main\", which has no machine; name another process, or declare "
                      "<process name=\"main\" machine=\"NAME\"/> with one of: " +
                      listed(model_.machine_names));
  }

  bool check_exists(const Node& node, const Text& name) {
    if (model_.find_process(name.value) != nullptr) return true;
    report_unknown(node, name, codes::kUnknownProcess, "process", model_.process_names,
                   "; declare it: <process name=" + in_quotes(name.value) + "/>", model_, report_);
    return false;
  }

  // @param decider  the component that decides the hardware's process
  void report_apart(const CheckedComponent& component, const CheckedHardware& hardware,
                    const CheckedComponent& decider) {
    report_.error(codes::kSplit, component.value.position,
                  "hardware " + in_quotes(hardware.value.name) +
                      " and the components that are bound to it live in one process, but " +
                      whereabouts(component.value) + ", and " + in_quotes(decider.value.name) + " is in " +
                      in_quotes(hardware.value.process) + "; name one process in all of them");
  }

  template <class Part>
  static std::string whereabouts(const Part& part) {
    return in_quotes(part.name) + " is in the process " + in_quotes(part.process);
  }

  Model& model_;
  Report& report_;
  // The components that decide the process of hardware.
  std::map<const CheckedHardware*, const CheckedComponent*> deciders_;
};

}  // namespace

void check_placement(const std::vector<Node>& components, Model& model, Report& report) {
  Placement placement(model, report);
  for (std::size_t i = 0; i < model.components.size(); ++i)
    placement.place(components[i], model.components[i]);
  for (const CheckedComponent& component : model.components) placement.join(component);
  placement.check_machine_of_main();
  placement.check_shared();
}

void check_nothing_runs(const Model& model, Report& report) {
  std::set<std::string> used;
  for (const CheckedHardware& hardware : model.hardware) used.insert(hardware.value.process);
  for (const CheckedComponent& component : model.components) used.insert(component.value.process);
  std::set<std::string> named;
  for (const CheckedProcess& process : model.processes) {
    named.insert(process.value.machine);
    if (used.contains(process.value.name)) continue;
    report.warning(codes::kNothingRuns, process.value.position,
                   "nothing runs in the process " + in_quotes(process.value.name) +
                       ", so it is not started; name it in components, or remove it");
  }
  for (const MachineNode& machine : model.machines) {
    if (named.contains(machine.name)) continue;
    report.warning(
        codes::kNothingRuns, machine.position,
        "no process runs on the machine " + in_quotes(machine.name) + "; name it in a process, or remove it");
  }
}

}  // namespace orca::graph
