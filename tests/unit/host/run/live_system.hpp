// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "diary.hpp"
#include "executives.hpp"
#include "orca/host/catalogue.hpp"
#include "run/system/system.hpp"

namespace orca::test {

/// A system of the plugins beside this file, brought up in the test's own process. What its components log
/// with level debug goes into a diary.
class LiveSystem {
 public:
  /// @param elements  of the graph.
  explicit LiveSystem(std::string elements) : elements_(std::move(elements)) {}

  /// Adds a component type of the test itself, which outlives the object.
  void add(const TypeEntry& type) { own_types_.push_back(&type); }

  /// Brings the system up, calls `body` as the executive's main task, and takes the system down.
  void run(const ExecutiveOptions& executive, const std::function<void(LiveSystem&)>& body);

  [[nodiscard]] host::System& system() { return *system_; }
  [[nodiscard]] Event& changed() { return *changed_; }
  [[nodiscard]] const graph::Graph& graph() const { return *graph_; }
  [[nodiscard]] host::RunContext& context() { return *context_; }
  [[nodiscard]] host::PluginCatalogue& catalogue() { return *catalogue_; }
  [[nodiscard]] Executive& executive() { return *executive_; }
  [[nodiscard]] TimePoint soon() const { return executive_->now() + 5s; }
  [[nodiscard]] host::ComponentState state(const std::string& component) const {
    return system_->component(component)->state();
  }

  Status suspend(const std::string& name) { return system_->suspend(name, *changed_, soon()); }
  Status resume(const std::string& name) { return system_->resume(name, *changed_, soon()); }
  Status set(const std::string& name, const std::map<std::string, std::string>& texts) {
    return system_->set_params(name, texts, *changed_, soon());
  }
  void sleep(Duration time) { orca::test::sleep(*executive_, time); }

  /// What the components have logged since the last call.
  std::vector<std::string> news();
  Diary diary;

 private:
  void with(Executive& executive, const std::function<void(LiveSystem&)>& body);

  std::string elements_;
  std::vector<const TypeEntry*> own_types_;
  Executive* executive_ = nullptr;
  Event* changed_ = nullptr;
  host::System* system_ = nullptr;
  const graph::Graph* graph_ = nullptr;
  host::RunContext* context_ = nullptr;
  host::PluginCatalogue* catalogue_ = nullptr;
  std::size_t read_ = 0;
};

/// A component that works without clients.
inline const std::string kAutonomousLife = R"(<component name="life" type="test.Life" autonomous="true"/>)";

/// Where the plugin is.
[[nodiscard]] inline std::string host_plugin(const std::string& name) {
  return std::string(ORCA_BINARY_DIR "/tests/host_plugins/") + name + ".so";
}

}  // namespace orca::test
