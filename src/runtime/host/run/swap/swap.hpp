// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "candidate_task.hpp"
#include "exchange.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/host/swap.hpp"
#include "orca/plugin/image.hpp"
#include "run/component/component_instance.hpp"
#include "run/reporting/run_context.hpp"
#include "run/trial/backdrop.hpp"
#include "run/trial/quiet_run.hpp"

namespace orca::host {

/// One exchange of a component's code while the system runs (docs/adr/0008): the new object is made and configured beside
/// the old one, takes its place between two laps, and is on probation until the old one is destroyed.
///
/// Whatever is not in its place, the new object or the old one, runs on a thread of its own, with limits of its own. If it hangs, the
/// exchange ends without it: what sleeps stays in memory, and for what computes the process is given up, as for an
/// object that hangs in its place.
///
/// Thread contract: one task, which does not run the component.
class Swap final : public Exchange {
 public:
  /// What a swap needs of its surroundings. All of it outlives the swap.
  struct Place {
    const graph::Graph& graph;  ///< With all connections of the component, to whichever process.
    RunContext& run;
    PluginCatalogue& catalogue;
    ComponentInstance& component;
    std::string type;  ///< Of its present object.
    /// Ends the process because a component, or what was to take its place, hangs; empty: nobody does.
    const Standstill& stand_still;
  };

  Swap(const Place& place, SwapOrder order);
  ~Swap() override;
  Swap(const Swap&) = delete;
  Swap& operator=(const Swap&) = delete;

  /// @errors  failed_precondition if the component cannot be exchanged.
  Status prepare() override;
  /// @return also the errors of PluginCatalogue::acquire(); failed_precondition with all differences; invalid_argument for
  ///         parameters; internal with what a constructor threw; deadline_exceeded if something takes too long.
  std::optional<Result<SwapReport>> step() override;
  Result<SwapReport> give_up() override;
  [[nodiscard]] TimePoint wake_up() const override;
  [[nodiscard]] const std::string& name() const override { return order_.component; }
  [[nodiscard]] bool is_stuck() const override { return is_stuck_; }

 private:
  enum class Phase { making, configuring, taking_over, in_take_over, probation, going_back, ending };
  using Outcome = std::optional<Result<SwapReport>>;

  Status make();
  Status connect();
  Status acquire(LoadedType& type, Contract& contract);
  Status make_successor(const LoadedType& type, const Contract& contract);
  Outcome made();
  Outcome configured();
  Outcome taken_over();
  Outcome withdraw();
  Outcome watch();
  [[nodiscard]] bool is_in_long_lap() const;
  Outcome wait_for_lap();
  Outcome end(Result<SwapReport> outcome);
  Outcome ended();
  Outcome leave_behind(const std::string& hangs);
  Outcome lose(const std::string& hangs);
  void enter(Phase phase, Duration limit);
  [[nodiscard]] Error refuse(Code code, const std::string& why) const;

  const Place place_;
  SwapOrder order_;
  QuietRun beside_;  // surroundings of the new object while it is configured
  Backdrop backdrop_;
  std::atomic<bool> is_loading_{false};  // and not only constructing
  Status made_;                          // set before the task is done
  CandidateTask task_;  // makes the new object, or destroys the one that is not needed any more
  std::vector<PortContract> offered_;  // by the new type
  std::unique_ptr<ComponentInstance> successor_;
  Phase phase_ = Phase::making;
  std::shared_ptr<Order> pending_;  // at the component
  TakeOver take_over_;
  Duration overtime_{0};  // of the probation, until a lap ends
  SwapReport report_;
  Outcome outcome_;  // once the object that is not needed any more has ended
  bool is_stuck_ = false;
};

}  // namespace orca::host
