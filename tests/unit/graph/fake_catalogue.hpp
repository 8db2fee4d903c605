// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "orca/graph/loader.hpp"

/// A catalogue without plugins: the contracts of the shipped plugins, and some contracts with faults.
///
/// A hardware whose parameter "world" ends in "broken.world" has a broken world file, one where it ends in
/// "flooded.world" cannot work with that value, and one where it ends in "foggy.world" is doubtful. A hardware
/// "orca.hw.Deep" has a fault at its parameter "ship" that follows from a "depth" of 0. Two "orca.hw.Sim" of one world must share a process. A component whose parameter
/// "label" is "torn" refuses it, one where it is "lost" ends its trial. "test.Clock" is unfit for any run, for two
/// reasons.
class FakeCatalogue final : public orca::graph::Catalogue {
 public:
  FakeCatalogue();

  void add_folders(const std::vector<std::string>& folders) override;
  orca::Result<orca::Contract> hardware(const std::string& type) override;
  std::vector<orca::HardwareFault> validate_hardware(const orca::graph::HardwareUse& use) override;
  std::vector<orca::HardwareFault> hardware_conflicts(const orca::graph::HardwareUse& use,
                                                      const orca::graph::HardwareUse& earlier) override;
  orca::Result<orca::Contract> component(const std::string& type,
                                         const orca::graph::HardwareUse* hardware) override;
  std::vector<orca::graph::ComponentFault> try_components(const orca::graph::Graph& graph,
                                                          const orca::graph::Candidates& candidates) override;
  std::vector<std::string> unfit(orca::PluginKind kind, const std::string& type) override;
  /// Laser scans have one message, motion commands two.
  [[nodiscard]] std::vector<std::string> messages(const std::string& object_type, bool leave) const override;
  [[nodiscard]] std::vector<std::string> type_names(orca::PluginKind kind) const override;

  void add(orca::Contract contract) { types_[contract.type] = std::move(contract); }

  /// The calls that it received, in order: "folders /a;/b", "hardware T", "validate NAME", "component T with
  /// NAME", "try NAME" or "doubt NAME" for each component that is to be configured.
  std::vector<std::string> calls;

 private:
  orca::Result<orca::Contract> find(const std::string& type, orca::PluginKind kind) const;

  std::map<std::string, orca::Contract> types_;
};
