// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/base/doorbell.hpp"
#include "orca/base/executive.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/host/component_report.hpp"
#include "orca/host/kept_state.hpp"
#include "orca/host/part_access.hpp"
#include "orca/host/peer_call.hpp"
#include "orca/host/planned_failure.hpp"
#include "orca/host/run_listener.hpp"
#include "orca/host/run_outputs.hpp"
#include "orca/host/run_result.hpp"

namespace orca::host {

/// The observer of a part.
///
/// Thread contract: as RunListener.
class PartListener : public RunListener {
 public:
  /// Reports what has become of a component, each time that it has changed.
  /// @thread  the part's main task.
  virtual void component_changed(const std::string& component, const ComponentReport& report) = 0;
  /// Reports whether nothing is in use any more, components and hardware, each time that this has changed.
  /// @thread  the part's main task.
  virtual void rest_changed(bool at_rest) = 0;
  /// Reports what the connections that end in this process carried, and how far its robots have driven, just before
  /// everything is taken down.
  /// @thread  the part's main task.
  virtual void counted(const RunCounters& counters, const std::vector<RunResult::Way>& ways) = 0;
  /// Takes the state of a component that is to begin with it if the process is lost.
  /// @thread  the component's strand.
  virtual void state_kept(const std::string& component, const KeptState& state) = 0;
  /// Takes the order of a component about another one, in whatever process that is.
  /// @thread  the part's main task.
  virtual void peer_called(const PeerCall& call) = 0;
  /// Reports that the memory of an edge to another process holds what cannot be. The edge is cut until it gets new memory.
  /// @param edge  graph::Edge::name().
  /// @thread  the strand of the port.
  virtual void edge_damaged(const std::string& edge) = 0;
  /// Reports that an output could not be written.
  /// @thread  the part's main task, or the thread that calls HostedPart::write_outputs().
  virtual void output_failed(const Error& error) = 0;
};

/// The options of a part.
struct PartOptions {
  std::uint64_t seed = 1;
  std::vector<PlannedFailure> failures{};
  std::string log_name = "orca";  ///< Name in the log for what concerns no single component.
  /// A component that works and does not wait for anything of Orca for this long [s] hangs: the motors are stopped, and the
  /// listener is to abandon the process; 0: it is only reported.
  Duration hang_limit{0};
  std::atomic<std::uint64_t>* missions = nullptr;  ///< Number of missions begun so far, in all parts.
  /// Returns the word by which other processes wake a component of the graph, in whatever process it is.
  std::function<DoorbellWord*(const std::string& component)> doorbell{};
  RunOutputs outputs{};  ///< Of this process.
  std::string run{};     ///< The same in all processes of a run, and in no other run.
  KeptStates states{};   ///< With what components begin.
  /// Returns by how much the clock of a machine, counted as in the graph, is ahead of this one's at present [s], as far as the
  /// instants in what it sends are to be corrected; none: there is one clock. Any thread.
  std::function<Duration(std::size_t machine)> clock_ahead{};
};

/// What a part needs of its surroundings. All of it outlives the part.
struct PartPlace {
  PluginCatalogue& catalogue;
  Executive& executive;
  PartListener& listener;
};

/// The part of a system that this process runs. It does nothing by itself, but obeys orders.
///
/// Thread contract: stop_motors() and the functions of PartAccess from any thread once it is built, the rest from one.
class HostedPart final : public PartAccess {
 public:
  /// @param whole    the graph of all processes. Catalogue, executive and listener outlive the object.
  /// @param process  the one that this process is.
  HostedPart(const graph::Graph& whole, const std::string& process, const PartPlace& place,
             const PartOptions& options);
  ~HostedPart() override;

  /// Opens the outputs, constructs everything and connects all edges.
  /// @param memory  of each edge to another process through shared memory, by graph::Edge::name().
  /// @errors  as OutputFile::open(); with the name of what cannot be constructed.
  Status build(std::map<std::string, Descriptor> memory);
  /// Returns the names of the robots, by their hardware.
  /// @pre  build() has succeeded.
  [[nodiscard]] std::map<std::string, std::string> robots() const;

  /// Obeys orders until everything has been taken down.
  void run();

  /// Draws the picture, and writes what is left of all outputs. The listener learns what could not be written.
  /// @pre  run() has returned.
  void write_outputs();

  /// Stops the motors and closes the hardware, while this process is about to end; waits for it, but not for long.
  void stop_motors();

  void order(PartOrder order) override;
  void prepare_for_death() override;
  [[nodiscard]] RunGlance look() const override;
  void hold(const std::string& reason) override;
  bool hold_devices(const std::string& reason) override;
  bool let_go() override;
  [[nodiscard]] RunCounters counters() const override;
  [[nodiscard]] Result<std::shared_ptr<PortTap>> tap(const std::vector<graph::PortRef>& ports,
                                                     const PortTap::Bounds& bounds) override;
  Status offer(const graph::PortRef& port, ObjectLoan object,
               std::function<void(Result<ObjectRef>)> answered) override;
  void hear(const idl::Alarm& alarm, const std::string& process) override;
  void forget_alarm(const std::string& kind, const std::string& source, const std::string& process) override;
  void cut_edge(const std::string& edge, const Error& reason) override;
  Status renew_edge(const std::string& edge, const Descriptor& memory) override;
  Status move_edge(const std::string& edge) override;

 private:
  class Inside;
  const std::unique_ptr<Inside> inside_;
};

}  // namespace orca::host
