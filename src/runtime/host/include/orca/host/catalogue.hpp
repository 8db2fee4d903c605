// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/executive.hpp"
#include "orca/graph/loader.hpp"
#include "orca/host/alarm.hpp"
#include "orca/plugin/describe.hpp"
#include "orca/plugin/index.hpp"
#include "orca/plugin/library.hpp"

namespace orca::host {

/// A type, and the plugin that holds its code: it stays in memory for as long as somebody holds this.
struct LoadedType {
  std::shared_ptr<plugin::PluginLibrary> library;
  const TypeEntry* entry = nullptr;
};

/// Answers the graph checker's questions from the plugins themselves, and loads and unloads them for those
/// who run them.
///
/// Thread contract: acquire() and release() from anywhere, the rest from one thread.
class PluginCatalogue final : public graph::Catalogue {
 public:
  /// @param clock  of the run that the plugins are for.
  explicit PluginCatalogue(plugin::PluginIndex index, ClockKind clock = ClockKind::steady);
  ~PluginCatalogue() override;

  void add_folders(const std::vector<std::string>& folders) override { index_.add(folders); }
  Result<Contract> hardware(const std::string& type) override;
  std::vector<HardwareFault> validate_hardware(const graph::HardwareUse& use) override;
  Result<Contract> component(const std::string& type, const graph::HardwareUse* hardware) override;
  /// In virtual time: what of the machine's time, threads and randomness the type's plugin uses.
  [[nodiscard]] std::vector<std::string> unfit(PluginKind kind, const std::string& type) override;
  [[nodiscard]] std::vector<std::string> type_names(PluginKind kind) const override;

  /// A type, its plugin loaded if nobody has done so before.
  /// @errors  not_found with the places searched, and plugin::PluginLibrary::load()'s.
  Result<LoadedType> acquire(PluginKind kind, const std::string& type);

  /// Lets a type go, and unloads its plugin if nobody else holds it.
  /// @errors  failed_precondition if nobody holds the plugin and it is in memory all the same.
  Status release(LoadedType type);

  /// From now on alarms about plugins go to `sink`; null: only to the log, as at first.
  /// @thread  while nobody uses the catalogue.
  void on_alarm(AlarmSink sink) { sink_ = std::move(sink); }

  /// Lets go of all that was loaded and constructed only to answer questions.
  void forget_answers();

 private:
  Result<std::shared_ptr<plugin::PluginLibrary>> library_of(const std::string& type);
  Result<LoadedType> find(PluginKind kind, const std::string& type);
  Result<plugin::DescribedHardware*> described(const graph::HardwareUse& use);

  void raise_pinned(const std::string& file, const std::string& why) const;

  plugin::PluginIndex index_;
  const ClockKind clock_;
  AlarmSink sink_;
  mutable std::mutex mutex_;
  std::map<std::string, std::weak_ptr<plugin::PluginLibrary>> libraries_;  // by file
  std::map<std::string, LoadedType> held_;                                 // by type: what answers came from
  std::map<std::string, std::unique_ptr<plugin::DescribedHardware>> hardware_;  // by name in the graph
};

}  // namespace orca::host
