// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
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

/// A type, and the plugin that holds its code. The plugin stays in memory at least as long as this object
/// lives.
struct LoadedType {
  std::shared_ptr<plugin::PluginLibrary> library;  ///< Null: the code is part of this program.
  const TypeEntry* entry = nullptr;

  /// Returns the file of the code.
  [[nodiscard]] std::string file() const { return library ? library->path() : "/proc/self/exe"; }
};

/// A component whose configure() was tried. A plain value.
struct TrialSubject {
  graph::ComponentNode component;  ///< Without its name.
  graph::HardwareNode hardware;
  std::vector<std::string> ports;  ///< That are connected.
  friend bool operator==(const TrialSubject&, const TrialSubject&) = default;
};

/// Components that stood their trials.
///
/// Thread contract: not synchronised.
class TrialsStood {
 public:
  void add(TrialSubject subject) {
    std::vector<TrialSubject>& alike = by_params_[params_of(subject)];
    alike.push_back(std::move(subject));
  }
  [[nodiscard]] bool holds(const TrialSubject& subject) const {
    const auto alike = by_params_.find(params_of(subject));
    return alike != by_params_.end() && std::ranges::find(alike->second, subject) != alike->second.end();
  }

 private:
  using BothParams = std::pair<graph::Params, graph::Params>;  // in which most subjects differ
  static BothParams params_of(const TrialSubject& subject) {
    return {subject.component.params, subject.hardware.params};
  }
  std::map<BothParams, std::vector<TrialSubject>> by_params_;
};

/// The types of all plugins. It answers the graph checker's questions from the plugins themselves, and loads
/// and unloads plugins for a run.
///
/// Thread contract: acquire(), release() and refresh() from anywhere, the rest from one thread.
class PluginCatalogue final : public graph::Catalogue {
 public:
  /// @param clock  clock of the run that the plugins are for.
  explicit PluginCatalogue(plugin::PluginIndex index, ClockKind clock = ClockKind::steady);
  ~PluginCatalogue() override;

  /// Adds a component type whose code is part of this program. It hides one of its name in a plugin.
  /// @param type  must outlive this object.
  void add(const TypeEntry& type) { own_types_.push_back(&type); }

  /// Also loads the libraries of object types in these folders, as the constructor does for the others.
  void add_folders(const std::vector<std::string>& folders) override;
  Result<Contract> hardware(const std::string& type) override;
  std::vector<HardwareFault> validate_hardware(const graph::HardwareUse& use) override;
  std::vector<HardwareFault> hardware_conflicts(const graph::HardwareUse& use,
                                                const graph::HardwareUse& earlier) override;
  Result<Contract> component(const std::string& type, const graph::HardwareUse* hardware) override;
  void expect(const std::vector<std::string>& types) override;
  std::vector<graph::ComponentFault> try_components(const graph::Graph& graph,
                                                    const graph::Candidates& candidates) override;
  /// Returns the machine's time, threads and randomness that the type's plugin uses, if the run is in virtual
  /// time.
  [[nodiscard]] std::vector<std::string> unfit(PluginKind kind, const std::string& type) override;
  [[nodiscard]] std::vector<std::string> messages(const std::string& object_type, bool leave) const override;
  [[nodiscard]] std::vector<std::string> type_names(PluginKind kind) const override;

  /// Returns the folders of the plugins, those of the graph last.
  [[nodiscard]] const std::vector<std::string>& folders() const { return index_.folders(); }

  /// Reads the folders again: since the last time a plugin may have been built.
  void refresh();

  /// Returns a type, and loads its plugin unless it is loaded already.
  /// @errors  not_found with the places searched; the errors of plugin::PluginLibrary::load().
  Result<LoadedType> acquire(PluginKind kind, const std::string& type);

  /// Returns a type of a plugin that is loaded from an image, apart from all others.
  /// @errors  not_found with the types that the plugin has; the errors of plugin::PluginLibrary::load().
  Result<LoadedType> acquire(plugin::PluginImage image, PluginKind kind, const std::string& type,
                             plugin::Trial trial = plugin::Trial::now);

  /// Releases a type, and unloads its plugin if nobody else holds it.
  /// @errors  failed_precondition if nobody holds the plugin and it is in memory all the same.
  Status release(LoadedType type);

  /// Sends later alarms about plugins to `sink`; null: only to the log, as at first.
  /// @thread  while nobody uses the catalogue.
  void on_alarm(AlarmSink sink) { sink_ = std::move(sink); }

  /// Returns the hardware of a graph as it was prepared to be described, closed; null if it cannot be.
  [[nodiscard]] plugin::DescribedHardware* closed_hardware(const graph::HardwareUse& use);

  /// Sets the question whether to give up trials of components, for a program that is asked to stop meanwhile.
  void give_up_if(std::function<bool()> give_up) { give_up_ = std::move(give_up); }

  /// Forgets the folders and the hardware of a graph, so that another can be checked. Plugins stay loaded, and hardware of which the
  /// next graph has an equal one stays prepared: worlds and other files that it names are read once. Nor is a component of the next
  /// graph tried that is like one that stood its trial.
  void forget_graph();

  /// Releases everything that was loaded and constructed only to answer questions.
  void forget_answers();

 private:
  [[nodiscard]] const TypeEntry* own_type(PluginKind kind, const std::string& type) const;
  Result<std::shared_ptr<plugin::PluginLibrary>> library_of(const std::string& type);
  static Result<LoadedType> type_in(std::shared_ptr<plugin::PluginLibrary> library, PluginKind kind,
                                    const std::string& type);
  Result<LoadedType> find(PluginKind kind, const std::string& type);
  struct KnownHardware {
    const TypeEntry* entry = nullptr;
    std::unique_ptr<plugin::DescribedHardware> hardware{};
    std::optional<graph::Params> params{};  // with which it was prepared
    std::vector<HardwareFault> faults{};    // that were found then
  };
  Result<plugin::DescribedHardware*> described(const graph::HardwareUse& use);
  Result<KnownHardware*> describe_anew(const graph::HardwareUse& use);
  Result<KnownHardware*> prepared(const graph::HardwareUse& use);

  plugin::PluginIndex index_;
  const plugin::PluginIndex own_index_;  // as it was given, without folders of graphs
  std::vector<const TypeEntry*> own_types_;
  const ClockKind clock_;
  AlarmSink sink_;
  std::function<bool()> give_up_;
  mutable std::mutex mutex_;
  std::map<std::string, std::weak_ptr<plugin::PluginLibrary>> libraries_;  // by file
  std::map<std::string, LoadedType> held_;         // by type; kept because answers came from them
  std::map<std::string, KnownHardware> hardware_;  // by name in a graph: the last of each name
  std::set<std::string> of_graph_;                 // names of those of the graph that is checked now
  TrialsStood stood_;                              // in graphs that were forgotten, and in the one after them
  bool forgot_graph_ = false;                      // since components were tried
};

}  // namespace orca::host
