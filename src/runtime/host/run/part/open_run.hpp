// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "orca/graph/graph.hpp"
#include "orca/host/part_access.hpp"
#include "order_box.hpp"
#include "outer_ports.hpp"
#include "run/swap/swaps.hpp"
#include "run/system/watched_system.hpp"

namespace orca::host {

/// The door to a system that runs in one process, without a supervisor that conducts it: visitors look in, and their orders
/// are carried out between two moments. To look in changes nothing in the run; an order does.
///
/// Thread contract: PartAccess from any thread, the rest from the run's main task.
class OpenRun final : public PartAccess {
 public:
  /// What it opens. All of it outlives the object.
  struct Parts {
    const graph::Graph& graph;
    WatchedSystem& watched;
    Swaps& swaps;
    std::function<void()> prepare_for_death;
  };

  OpenRun(Parts run, RunVisitors& visitors);

  /// Lets the visitors in.
  /// @pre  the system is built.
  void open() { visitors_.enter(*this); }
  void came_up();
  /// Carries out what was ordered, and reports what has become of components.
  /// @return whether the end of the run was ordered.
  [[nodiscard]] bool obey();
  /// Lets time pass as fast as it can: the run is about to end.
  void hurry() { visitors_.pace().finish(); }
  /// Takes no more orders: the system is about to be taken down.
  void close() {
    hurry();
    orders_.close(ok());
  }
  /// Bids the visitors go.
  void leave() { visitors_.leave(); }

  void order(PartOrder order) override { orders_.put(std::move(order)); }
  void prepare_for_death() override { run_.prepare_for_death(); }
  [[nodiscard]] RunGlance look() const override;
  void hold(const std::string& reason) override { (void)system().hold(reason, Movers::all); }
  bool hold_devices(const std::string& reason) override { return system().hold(reason, Movers::on_lines); }
  bool let_go() override { return system().let_go(); }
  [[nodiscard]] RunCounters counters() const override { return collect_counters(run_.graph, system()); }
  [[nodiscard]] Result<std::shared_ptr<PortTap>> tap(const std::vector<graph::PortRef>& ports,
                                                     const PortTap::Bounds& bounds) override;
  Status offer(const graph::PortRef& port, ObjectLoan object,
               std::function<void(Result<ObjectRef>)> answered) override;
  void hear(const idl::Alarm& alarm, const std::string& process) override;
  void forget_alarm(const std::string& kind, const std::string& source, const std::string& process) override;
  void cut_edge(const std::string& /*edge*/, const Error& /*reason*/) override {}  // none leads elsewhere
  Status renew_edge(const std::string& edge, const Descriptor& memory) override;
  Status move_edge(const std::string& edge) override;

 private:
  [[nodiscard]] System& system() const { return run_.watched.system(); }
  void carry_out(PartOrder& order);
  Status act(const PartOrder& order);
  void report_changes();

  const Parts run_;
  RunVisitors& visitors_;
  OuterPorts ports_;  // the system's ports answer to it
  OrderBox orders_;
  std::map<std::string, ComponentReport> reported_;
};

}  // namespace orca::host
