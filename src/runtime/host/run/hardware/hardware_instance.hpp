// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "containment/guard.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/hw/container.hpp"
#include "run/reporting/run_context.hpp"

namespace orca::host {

/// One hardware container in this process, with its driver.
///
/// Thread contract: as HardwareContainer.
class HardwareInstance final : public hw::HardwareHost {
 public:
  HardwareInstance(RunContext& run, std::string name, LoadedType type);
  ~HardwareInstance() override;

  /// Constructs the container, sets its parameters and declares its endpoints.
  /// @errors  internal with what it threw; invalid_argument with the first error in its files.
  Status construct(const std::map<std::string, ParamValue>& params);

  [[nodiscard]] hw::HardwareContainer& container() { return *container_; }
  /// Returns what it is, as the driver has said once.
  /// @pre  construct() has succeeded.
  [[nodiscard]] const idl::Robot& description() const { return description_; }
  /// Returns the parameters that construct() was given.
  [[nodiscard]] const std::map<std::string, ParamValue>& params() const { return values_; }
  /// Returns the name of the robot that this hardware moves, one word; empty if it moves nothing.
  /// @pre  construct() has succeeded.
  [[nodiscard]] const std::string& robot() const { return robot_; }

  /// Makes its faults a matter of whoever tries it, so that they raise no alarm, until accept().
  /// @pre  it does not run yet.
  void put_on_trial() { on_trial_.store(true); }
  void accept();

  // PluginHost and HardwareHost
  void declare_param(ParamDeclaration declaration) override { params_.push_back(std::move(declaration)); }
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] TimePoint now() const override { return run_.executive.now(); }
  [[nodiscard]] RandomStream random(std::string_view stream) const override {
    return {run_.seed, name_, stream};
  }
  void write_log(log::Level level, std::string_view text) const override {
    run_.reporter.log(level, name_, text, mission());
  }
  void report(const idl::Contact& contact) override;
  [[nodiscard]] std::uint64_t run_seed() const override { return run_.seed; }
  void state_changed(hw::HardwareState state) override;
  void held(const std::optional<std::string>& reason) override;
  void pausing() override { pause_plugin_turn(); }
  [[nodiscard]] Executive& executive() override { return run_.executive; }
  void truly_at(const std::string& robot, const Pose2& X_WR) override {
    run_.reporter.note_truth(robot, X_WR);
  }

 private:
  [[nodiscard]] std::string find_robot() const;
  // Returns the mission of the command that its base carries out; 0: none.
  [[nodiscard]] std::uint64_t mission() const;
  void raise_fault();

  RunContext& run_;
  const std::string name_;
  const LoadedType type_;  // outlives the container
  std::vector<ParamDeclaration> params_;
  hw::HardwareContainer* container_ = nullptr;
  std::map<std::string, ParamValue> values_;
  idl::Robot description_;
  std::string robot_;
  hw::HardwareState traced_ = hw::HardwareState::closed;
  std::atomic<bool> on_trial_{false};
};

}  // namespace orca::host
