// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "candidate_task.hpp"
#include "exchange.hpp"
#include "orca/host/catalogue.hpp"
#include "run/hardware/hardware_place.hpp"
#include "run/reporting/run_context.hpp"

namespace orca::host {

/// One exchange of a driver while the system runs (docs/adr/0008). The motors stop and are held, the present driver closes the
/// device, and the new one opens it. If that is not ready in time, the present one opens it again. The servers on the
/// hardware see a pause.
///
/// The new driver is made on a task of its own, within 10 s. If it hangs there, the present one goes on: what sleeps stays in memory, and
/// for what computes the process is given up.
///
/// Thread contract: one task, the executive's main task.
class DriverSwap final : public Exchange {
 public:
  /// What it needs of its surroundings. All of it outlives the exchange.
  struct Site {
    RunContext& run;
    PluginCatalogue& catalogue;
    HardwarePlace& place;
    std::string type;     ///< Of the present driver.
    std::string process;  ///< Name in the graph, for people.
    /// Ends the process because what was to take the driver's place hangs; empty: nobody does.
    const Standstill& stand_still;
  };

  DriverSwap(const Site& site, SwapOrder order);

  /// Begins to make the new driver beside the present one.
  /// @errors  unavailable while an earlier driver has not ended.
  Status prepare() override;
  /// @return also the errors of PluginCatalogue::acquire(); failed_precondition with all differences; invalid_argument for
  ///         parameters, and with all that its prepare() reports; deadline_exceeded if it hangs.
  std::optional<Result<SwapReport>> step() override;
  Result<SwapReport> give_up() override;
  [[nodiscard]] TimePoint wake_up() const override;
  [[nodiscard]] const std::string& name() const override { return order_.component; }
  /// A driver that was made and does not end belongs to the place.
  [[nodiscard]] bool is_stuck() const override { return is_stuck_; }

 private:
  enum class Phase { making, closing, opening, closing_new, opening_again };
  using Outcome = std::optional<Result<SwapReport>>;

  Result<std::unique_ptr<HardwareInstance>> make_driver();
  Outcome made();
  Outcome leave_behind();
  void begin();
  Outcome closed();
  Outcome opened();
  Outcome closed_new();
  Outcome opened_again();
  Outcome take();
  Outcome put_back(const std::string& why);
  void open(HardwareInstance& driver, Phase phase);
  void close(HardwareInstance& driver, Phase phase);
  [[nodiscard]] bool has_opened(HardwareInstance& driver) const;
  [[nodiscard]] bool is_late() const;
  [[nodiscard]] std::string trouble_of(HardwareInstance& driver) const;
  Result<SwapReport> undone(const std::string& what);
  [[nodiscard]] std::string way_out() const;
  [[nodiscard]] Error refuse(Code code, const std::string& why) const;

  const Site site_;
  SwapOrder order_;
  std::atomic<bool> is_loading_{false};                      // and not only constructing
  Result<std::unique_ptr<HardwareInstance>> made_{nullptr};  // set before the task is done
  CandidateTask task_;                                       // makes the new driver
  bool is_stuck_ = false;
  Phase phase_ = Phase::making;
  TimePoint began_{};
  TimePoint limit_{};
  bool is_to_start_ = false;  // whether the driver that is being opened has to start the device
  std::string why_;           // the new driver was not taken
  SwapReport report_;
};

}  // namespace orca::host
