// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "orca/base/executive.hpp"
#include "orca/graph/loader.hpp"
#include "orca/plugin/describe.hpp"
#include "orca/plugin/index.hpp"
#include "orca/plugin/library.hpp"

namespace orca {

/// Answers the graph checker's questions from the plugins themselves, and keeps those that it has loaded.
///
/// Thread contract: one thread.
class PluginCatalogue final : public graph::Catalogue {
 public:
  /// @param clock  of the run that the plugins are for.
  explicit PluginCatalogue(PluginIndex index, ClockKind clock = ClockKind::steady);
  ~PluginCatalogue() override;

  void add_folders(const std::vector<std::string>& folders) override { index_.add(folders); }
  Result<Contract> hardware(const std::string& type) override;
  std::vector<HardwareFault> validate_hardware(const graph::HardwareUse& use) override;
  Result<Contract> component(const std::string& type, const graph::HardwareUse* hardware) override;
  /// In virtual time: what of the machine's time, threads and randomness the type's plugin uses.
  [[nodiscard]] std::vector<std::string> unfit(PluginKind kind, const std::string& type) override;
  [[nodiscard]] std::vector<std::string> type_names(PluginKind kind) const override;

  /// The entry of a type, its plugin loaded.
  /// @errors  not_found with the places searched, and PluginLibrary::load()'s.
  Result<const TypeEntry*> find(PluginKind kind, const std::string& type);

  /// The plugins that are loaded now.
  [[nodiscard]] std::vector<std::string> loaded_files() const;

 private:
  Result<PluginLibrary*> library_of(const std::string& type);
  Result<DescribedHardware*> described(const graph::HardwareUse& use);

  PluginIndex index_;
  const ClockKind clock_;
  std::map<std::string, std::unique_ptr<PluginLibrary>> libraries_;     // by file
  std::map<std::string, std::unique_ptr<DescribedHardware>> hardware_;  // by name in the graph
};

}  // namespace orca
