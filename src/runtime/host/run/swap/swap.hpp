// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "exchange.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/host/swap.hpp"
#include "orca/plugin/image.hpp"
#include "run/component/component_instance.hpp"
#include "run/run_context.hpp"
#include "run/trial/backdrop.hpp"
#include "run/trial/quiet_run.hpp"

namespace orca::host {

/// One exchange of a component's code while the system runs (docs/adr/0008): the new object is made and configured beside
/// the old one, takes its place between two laps, and is on probation until the old one is destroyed.
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
  };

  Swap(const Place& place, SwapOrder order);
  ~Swap() override;
  Swap(const Swap&) = delete;
  Swap& operator=(const Swap&) = delete;

  /// Also lets the new object configure itself.
  /// @errors  those of PluginCatalogue::acquire(); failed_precondition with all differences; invalid_argument for
  ///          parameters; internal with what a constructor threw.
  Status prepare() override;
  std::optional<Result<SwapReport>> step() override;
  Result<SwapReport> give_up() override;
  [[nodiscard]] TimePoint wake_up() const override;
  [[nodiscard]] const std::string& name() const override { return order_.component; }
  [[nodiscard]] bool is_stuck() const override { return is_stuck_; }

 private:
  enum class Phase { configuring, taking_over, probation, confirming };

  Status acquire(LoadedType& type, Contract& contract);
  Status make_successor(const LoadedType& type, const Contract& contract);
  std::optional<Result<SwapReport>> configured();
  std::optional<Result<SwapReport>> taken_over();
  std::optional<Result<SwapReport>> watch();
  std::optional<Result<SwapReport>> confirmed();
  Result<SwapReport> end(Result<SwapReport> outcome);
  void await(Phase phase, std::shared_ptr<Order> order);
  [[nodiscard]] Error refuse(Code code, const std::string& why) const;

  const Place place_;
  SwapOrder order_;
  QuietRun beside_;  // surroundings of the new object while it is configured
  Backdrop backdrop_;
  std::unique_ptr<ComponentInstance> successor_;
  Phase phase_ = Phase::configuring;
  TimePoint limit_{};
  std::shared_ptr<Order> pending_;  // at the component
  TakeOver take_over_;
  SwapReport report_;
  bool is_stuck_ = false;
};

}  // namespace orca::host
