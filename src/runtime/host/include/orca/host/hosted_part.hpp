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
#include "orca/host/planned_failure.hpp"
#include "orca/host/port_taps.hpp"
#include "orca/host/run_listener.hpp"
#include "orca/host/run_outputs.hpp"
#include "orca/host/run_result.hpp"
#include "orca/host/run_view.hpp"
#include "orca/host/swap.hpp"
#include "orca/idl/object.hpp"

namespace orca::host {

/// A connection that is made or removed while its components run, at this process.
struct ConnectionChange {
  graph::Edge edge;
  bool makes = true;
  Descriptor memory{};  ///< Of a connection to another process that is made.
};

/// An order for the part of a system that one process runs.
struct PartOrder {
  enum class Kind {
    open_hardware,  ///< Opens all hardware.
    configure,      ///< Configures a component.
    open_gates,     ///< Lets all components work.
    take_down,      ///< Stops the motors and ends all strands. The last order.
    suspend,        ///< Pauses a component between two laps.
    resume,         ///< Resumes a component.
    set_params,     ///< Gives a component new parameter values, all or none.
    add,     ///< Learns of a component that is new in the graph, and constructs it if it is this process's.
    remove,  ///< Ends a component that nobody is connected to any more.
    open_gate,     ///< Lets one component work.
    rewire,        ///< Makes and removes connections, between two laps of the components at their ends.
    check_unused,  ///< Does nothing; refused if a component is in use, with its name.
    swap,          ///< Exchanges a component's code. Other orders are carried out meanwhile.
  };
  /// Takes the outcome, on the part's main task. It must not block.
  using Done = std::function<void(const Status&)>;

  Kind kind = Kind::open_hardware;
  std::string component{};                      ///< Of the orders that concern one.
  std::map<std::string, std::string> params{};  ///< Values as written in a graph, with units.
  Done done{};
  bool keeps_states = false;  ///< Whether components hand out their states when they are taken down.
  /// The component to add, if that is the order. Its parameters are those in `params`.
  std::shared_ptr<graph::ComponentNode> node{};
  std::shared_ptr<SwapOrder> swap{};  ///< What is to be exchanged, if that is the order.
  /// The connections of one component to make and to remove, in this order, if that is the order: of a client, or of a server
  /// whose client is in another process. What is so already is made anew, or left alone. All of them change, or none.
  std::shared_ptr<std::vector<ConnectionChange>> connections{};
  /// Takes the outcome of a swap instead of `done`, on the part's main task. It must not block.
  std::function<void(const Result<SwapReport>&)> swapped{};
};

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
};

/// What a part needs of its surroundings. All of it outlives the part.
struct PartPlace {
  PluginCatalogue& catalogue;
  Executive& executive;
  PartListener& listener;
};

/// The part of a system that this process runs. It does nothing by itself, but obeys orders.
///
/// Thread contract: order(), stop_motors() and all functions after it from any thread once it is built, the rest from one.
class HostedPart {
 public:
  /// @param whole    the graph of all processes. Catalogue, executive and listener outlive the object.
  /// @param process  the one that this process is.
  HostedPart(const graph::Graph& whole, const std::string& process, const PartPlace& place,
             const PartOptions& options);
  ~HostedPart();
  HostedPart(const HostedPart&) = delete;
  HostedPart& operator=(const HostedPart&) = delete;

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

  /// Gives an order. Orders are carried out one after the other. One that comes after take_down is refused; those before it
  /// wait no longer for components or hardware.
  void order(PartOrder order);

  /// Stops the motors and closes the hardware, while this process is about to end; waits for it, but not for long.
  void stop_motors();
  /// Stops the motors, and writes as much of the outputs as there is, while this process is about to end.
  void prepare_for_death();

  /// Returns what the part is like at this moment: hardware that is not well, goals. The rest is the listener's to know.
  /// @pre  it is built.
  [[nodiscard]] RunGlance look() const;

  /// Stops what moves and refuses commands to move, until let_go(). Everything else goes on.
  /// @param reason  for people: "emergency stop".
  void hold(const std::string& reason);
  /// The same for the hardware alone that is on a line to a device.
  /// @return whether there is any.
  bool hold_devices(const std::string& reason);
  /// Returns whether anything was held.
  bool let_go();

  /// Returns the counters of the connections that end in this process.
  [[nodiscard]] RunCounters counters() const;
  /// Opens a tap of some ports. It must be closed before this object is destroyed.
  /// @errors  not_found.
  [[nodiscard]] Result<std::shared_ptr<PortTap>> tap(const std::vector<graph::PortRef>& ports,
                                                     const PortTap::Bounds& bounds);
  /// Hands an object from outside to a SendServer, or a question to a QueryServer. Such an object begins a mission of its
  /// own.
  /// @param answered  takes the outcome, with the reply of a QueryServer; called now or later, on any thread, unless the
  ///                  component ends before. It must not block.
  /// @errors  not_found; invalid_argument if the port takes no such object.
  Status offer(const graph::PortRef& port, ObjectLoan object,
               std::function<void(Result<ObjectRef>)> answered);

  /// Takes an alarm that was raised elsewhere, for components that pass alarms on.
  /// @param process  that it is about; empty: not one alone.
  void hear(const idl::Alarm& alarm, const std::string& process);
  /// Forgets an alarm that was acknowledged.
  /// @param process  that it is about, this one, too; empty: not one alone.
  void forget_alarm(const std::string& kind, const std::string& source, const std::string& process);

  /// Calls a function that opens descriptors in this process, which no component has opened. Any thread.
  void open_descriptors(const std::function<void()>& open);

  // Edges are named as graph::Edge::name() says.

  /// Cuts an edge to another process, because that is gone: whoever waits for an answer gets an error that says why.
  void cut_edge(const std::string& edge, const Error& reason);
  /// Gives an edge new memory, because the process at its other end has been started again. Subscriptions stand again
  /// without the components' doing.
  /// @errors  not_found; invalid_argument if it is no memory for an edge.
  Status renew_edge(const std::string& edge, const Descriptor& memory);
  /// Lets a port of this process use an edge from now on, of those that it chooses from.
  /// @errors  not_found.
  Status move_edge(const std::string& edge);

 private:
  class Inside;
  const std::unique_ptr<Inside> inside_;
};

}  // namespace orca::host
