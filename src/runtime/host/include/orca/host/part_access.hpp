// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"
#include "orca/base/system/pace.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/alarm.hpp"
#include "orca/host/component_report.hpp"
#include "orca/host/port_taps.hpp"
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
    conclude,      ///< Gives a component the outcome of its order about another one.
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
  /// The number of the component's own order and its outcome, if the order is to conclude it.
  std::shared_ptr<std::pair<std::uint64_t, Result<std::string>>> outcome{};
  std::shared_ptr<SwapOrder> swap{};  ///< What is to be exchanged, if that is the order.
  /// The connections of one component to make and to remove, in this order, if that is the order: of a client, or of a server
  /// whose client is in another process. What is so already is made anew, or left alone. All of them change, or none.
  std::shared_ptr<std::vector<ConnectionChange>> connections{};
  /// Takes the outcome of a swap instead of `done`, on the part's main task. It must not block.
  std::function<void(const Result<SwapReport>&)> swapped{};
};

/// What others may ask of the part of a system that this process runs, or order it to do.
///
/// Thread contract: any thread, once it is built.
class PartAccess {
 public:
  PartAccess() = default;
  virtual ~PartAccess() = default;
  PartAccess(const PartAccess&) = delete;
  PartAccess& operator=(const PartAccess&) = delete;

  /// Gives an order. Orders are carried out one after the other. One that comes after take_down is refused; those before it
  /// wait no longer for components or hardware.
  virtual void order(PartOrder order) = 0;

  /// Stops the motors, and writes as much of the outputs as there is, while this process is about to end.
  virtual void prepare_for_death() = 0;

  /// Returns what the part is like at this moment: hardware that is not well, goals. The rest is the listener's to know.
  [[nodiscard]] virtual RunGlance look() const = 0;

  /// Stops what moves and refuses commands to move, until let_go(). Everything else goes on.
  /// @param reason  for people: "emergency stop".
  virtual void hold(const std::string& reason) = 0;
  /// The same for the hardware alone that is on a line to a device.
  /// @return whether there is any.
  virtual bool hold_devices(const std::string& reason) = 0;
  /// Returns whether anything was held.
  virtual bool let_go() = 0;

  /// Returns the counters of the connections that end in this process.
  [[nodiscard]] virtual RunCounters counters() const = 0;
  /// Opens a tap of some ports. It must be closed before this object is destroyed.
  /// @errors  not_found.
  [[nodiscard]] virtual Result<std::shared_ptr<PortTap>> tap(const std::vector<graph::PortRef>& ports,
                                                             const PortTap::Bounds& bounds) = 0;
  /// Hands an object from outside to a SendServer, or a question to a QueryServer. Such an object begins a mission of its
  /// own.
  /// @param answered  takes the outcome, with the reply of a QueryServer; called now or later, on any thread, unless the
  ///                  component ends before. It must not block.
  /// @errors  not_found; invalid_argument if the port takes no such object.
  virtual Status offer(const graph::PortRef& port, ObjectLoan object,
                       std::function<void(Result<ObjectRef>)> answered) = 0;

  /// Takes an alarm that was raised elsewhere, for components that pass alarms on.
  /// @param process  that it is about; empty: not one alone.
  virtual void hear(const idl::Alarm& alarm, const std::string& process) = 0;
  /// Forgets an alarm that was acknowledged.
  /// @param process  that it is about, this one, too; empty: not one alone.
  virtual void forget_alarm(const std::string& kind, const std::string& source,
                            const std::string& process) = 0;

  /// Calls a function that opens descriptors in this process, which no component has opened.
  void open_descriptors(const std::function<void()>& open);

  // Edges are named as graph::Edge::name() says.

  /// Cuts an edge to another process, because that is gone: whoever waits for an answer gets an error that says why.
  virtual void cut_edge(const std::string& edge, const Error& reason) = 0;
  /// Gives an edge new memory, because the process at its other end has been started again. Subscriptions stand again
  /// without the components' doing.
  /// @errors  not_found; invalid_argument if it is no memory for an edge.
  virtual Status renew_edge(const std::string& edge, const Descriptor& memory) = 0;
  /// Lets a port of this process use an edge from now on, of those that it chooses from.
  /// @errors  not_found.
  virtual Status move_edge(const std::string& edge) = 0;
};

/// Those outside the graph who look at a run in virtual time, in this process, and give it orders.
///
/// Thread contract: one call after the other, on the thread that runs the system. No call may wait for the run.
class RunVisitors {
 public:
  RunVisitors() = default;
  virtual ~RunVisitors() = default;
  RunVisitors(const RunVisitors&) = delete;
  RunVisitors& operator=(const RunVisitors&) = delete;

  /// Returns the pace of the run, which they choose. It is finished when the run comes to its end.
  [[nodiscard]] virtual Pace& pace() = 0;
  /// Lets them in: everything is constructed, and nothing works yet.
  /// @param run  may be used until leave() returns.
  virtual void enter(PartAccess& run) = 0;
  /// Reports that everything is up, and may work from now on.
  virtual void came_up() = 0;
  /// Reports what has become of a component, each time that it has changed.
  virtual void component_changed(const std::string& component, const ComponentReport& report) = 0;
  /// Bids them go: the run is over.
  virtual void leave() = 0;
};

}  // namespace orca::host
