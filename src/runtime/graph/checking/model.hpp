// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/graph/graph.hpp"
#include "reading/merging/profiles.hpp"
#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

struct CheckedProcess {
  ProcessNode value;
  bool placed = true;  // false: its machine is not known, which is reported
};

struct CheckedHardware {
  HardwareNode value;
  bool sound = false;  // whether it may be shown to components
};

// Something that two hardware containers can share only within one process.
struct SharedThing {
  const Node* node;     // the later one
  std::string earlier;  // name of the other one
  HardwareFault fault;  // what there is to say if they are in different processes
};

// A port whose peers are chosen at run time, from candidates.
struct LateBinding {
  std::string port;  // its name in the graph
  Text candidates;
  std::string context;  // of the file that names them
};

// A name that the graph gives a port.
struct Renaming {
  std::string name;
  xml::Position position;
};

// A component of the graph, and what the checks know about it.
struct CheckedComponent {
  ComponentNode value;
  std::shared_ptr<const Contract> contract;  // null if the type is missing or unknown
  bool ports_known = false;  // false: its ports cannot be checked, for a reason reported already
  bool duplicate = false;
  bool process_known = true;  // false: it names a process that does not exist, which is reported
  bool sound = false;         // whether its own values are all known
  std::map<std::string, xml::Position> disabled;  // disabled ports, and the places that disable them
  std::map<std::string, Renaming> renamed;        // by the name that the author gave
  // Names that the graph wanted to give to ports and could not, which is reported.
  std::map<std::string, std::string> refused_names;
  // Ports that the graph wrongly declares to be unconnected, which is reported.
  std::set<std::string> wrongly_disabled;
  std::vector<LateBinding> late;

  // Returns the port that was to get `name` and did not, or null.
  [[nodiscard]] const PortContract* refused_port(const std::string& name) const {
    const auto found = refused_names.find(name);
    return found == refused_names.end() ? nullptr : contract->port(found->second);
  }
};

// The knowledge about the graph that the checks share. Nodes stay in the order of the file.
struct Model {
  std::vector<MachineNode> machines;
  std::vector<CheckedProcess> processes;  // those that the graph declares
  CheckedProcess implicit_main{{.name = kMainProcess}};
  std::vector<SharedThing> shared;
  std::vector<CheckedHardware> hardware;
  std::vector<CheckedComponent> components;
  std::map<std::string, std::size_t> process_by_name;
  std::map<std::string, std::size_t> hardware_by_name;
  std::map<std::string, std::size_t> component_by_name;
  std::vector<std::string> hardware_names;  // the same names, in the order of the file, for hints
  std::vector<std::string> component_names;
  std::vector<std::string> machine_names;
  std::vector<std::string> process_names{kMainProcess};  // "main" exists without a declaration
  std::set<std::string> excused;                         // see Structure
  bool names_incomplete = false;                         // see Structure
  bool parts_missing = false;                            // see Parts
  ProfilesByPart left_out;                               // see Parts
  bool any_link = false;                                 // see LoadOptions

  void add(CheckedProcess process, bool by_name) {
    const std::string& name = process.value.name;
    if (by_name && process_by_name.emplace(name, processes.size()).second && name != kMainProcess) {
      process_names.push_back(name);
    }
    processes.push_back(std::move(process));
  }

  void add(CheckedHardware node, bool by_name) {
    if (by_name && hardware_by_name.emplace(node.value.name, hardware.size()).second) {
      hardware_names.push_back(node.value.name);
    }
    hardware.push_back(std::move(node));
  }
  void add(CheckedComponent node, bool by_name) {
    if (by_name && component_by_name.emplace(node.value.name, components.size()).second) {
      component_names.push_back(node.value.name);
    }
    components.push_back(std::move(node));
  }
  [[nodiscard]] const CheckedComponent* component(const std::string& name) const {
    const auto found = component_by_name.find(name);
    return found == component_by_name.end() ? nullptr : &components[found->second];
  }
  [[nodiscard]] const CheckedProcess* find_process(const std::string& name) const {
    const auto found = process_by_name.find(name);
    if (found != process_by_name.end()) return &processes[found->second];
    return name == kMainProcess ? &implicit_main : nullptr;
  }
  [[nodiscard]] const CheckedHardware* find_hardware(const std::string& name) const {
    const auto found = hardware_by_name.find(name);
    return found == hardware_by_name.end() ? nullptr : &hardware[found->second];
  }
};

// Reports that a part names something that there is not, unless that may follow from an error that is reported already.
// @param kind    "machine"
// @param names   those that there are
// @param remedy  the end of the message if no name is near
void report_unknown(const Node& node, const Text& name, const char* code, const std::string& kind,
                    const std::vector<std::string>& names, const std::string& remedy, const Model& model,
                    Report& report);

// Returns whether `name` is a component. Reports at `place` that it is not, unless that is excused.
bool check_component_exists(const std::string& name, const xml::Position& place, const std::string& title,
                            const Model& model, Report& report);

}  // namespace orca::graph
