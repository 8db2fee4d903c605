// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "containment/environment.hpp"
#include "orca/base/executive.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/host/planned_failure.hpp"
#include "orca/host/run_listener.hpp"
#include "orca/hw/scene.hpp"
#include "run/recording/trace.hpp"
#include "run/reporting/reporter.hpp"
#include "run/reporting/run_context.hpp"
#include "system.hpp"

namespace orca::host {

inline constexpr Duration kStartLimit = 10s;        ///< For hardware to open, or components to come up.
inline constexpr Duration kTakeDownLimit = 1500ms;  ///< For all components to end.

/// What a watched system needs of its surroundings. All of it outlives the system.
struct SystemPlace {
  PluginCatalogue& catalogue;
  Executive& executive;
  Trace& trace;
  RunListener& listener;
};

/// The options of a watched system.
struct SystemOptions {
  std::uint64_t seed = 1;
  SceneWishes scene{};
  std::vector<PlannedFailure> failures{};
  std::string log_name = "orca";  ///< Name in the log for what concerns no single component.
  /// Number of missions begun so far, which processes may share; null: the system has its own.
  std::atomic<std::uint64_t>* missions = nullptr;
  /// Returns the word by which other processes wake a component; empty: there are no others.
  std::function<DoorbellWord*(const std::string& component)> doorbell{};
  StateSink state_sink{};      ///< Keeps the states of components for the case that the process is lost.
  KeptStates states{};         ///< With what components begin.
  double computing = 1.0;      ///< In virtual time laps take this many times as long as the graph says.
  bool measures_laps = false;  ///< Whether the processor time of each component's laps is measured.
  std::string run{};           ///< As of RunContext.
};

/// The instances of a graph in this process together with what watches over them: the reporter, the process's
/// environment, the monitor of stalls.
///
/// Thread contract: one thread, which becomes the executive's main task; members that are passed on have their own.
class WatchedSystem {
 public:
  /// Handles a component that holds up all others, on the monitor's own thread. It must end the process.
  /// @param text  what is wrong, with the hook.
  using Standstill = std::function<void(const std::string& component, const std::string& text)>;

  /// @param give_up  see System.
  WatchedSystem(const graph::Graph& graph, const SystemPlace& place, const SystemOptions& options,
                std::function<bool()> give_up);
  ~WatchedSystem();
  WatchedSystem(const WatchedSystem&) = delete;
  WatchedSystem& operator=(const WatchedSystem&) = delete;

  /// Constructs everything.
  /// @errors  as System::build().
  Status build() { return system_->build(place_.catalogue); }

  /// Runs `main` as the executive's main task, under the eyes of the monitor.
  void run(std::function<void()> main, const Standstill& standstill);

  /// Chooses whether from now on a component that stalls for this long is a standstill, whatever it holds up; 0 s: it is
  /// not.
  /// @thread  any.
  void set_hang_limit(Duration limit) { hang_limit_.store(limit); }

  /// Stops the motors while another thread is about to end the process. If all strands share that thread, only the
  /// watchdogs of the devices can.
  /// @thread  any, while the strands run.
  void stop_motors();

  /// Returns what a picture of the run shows, and what SystemOptions::scene has asked for.
  /// @pre  nothing runs any more.
  [[nodiscard]] Scene scene();

  /// Destroys all instances.
  void destroy() { system_.reset(); }

  [[nodiscard]] System& system() { return *system_; }
  [[nodiscard]] const System& system() const { return *system_; }
  [[nodiscard]] RunContext& context() { return context_; }
  [[nodiscard]] Reporter& reporter() { return reporter_; }
  [[nodiscard]] const Reporter& reporter() const { return reporter_; }
  /// Returns the event that is notified whenever an instance has changed its state.
  [[nodiscard]] Event& changed() { return *changed_; }
  [[nodiscard]] TimePoint start() const { return start_; }
  [[nodiscard]] Executive& executive() const { return place_.executive; }

 private:
  void raise(idl::Alarm alarm);

  const SystemPlace place_;
  Reporter reporter_;
  std::atomic<Duration> hang_limit_{Duration{0}};
  std::atomic<bool> runs_{false};      // whether there are strands
  const KeptEnvironment environment_;  // lives longer than all that runs a plugin's code
  const TimePoint start_ = place_.executive.now();
  std::unique_ptr<Event> changed_ = place_.executive.make_event();
  std::atomic<std::uint64_t> missions_{0};  // unless the options bring their own
  RunContext context_;
  std::optional<System> system_;
};

}  // namespace orca::host
