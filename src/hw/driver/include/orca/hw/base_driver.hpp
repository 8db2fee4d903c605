// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orca/hw/base_figures.hpp"
#include "orca/hw/line_driver.hpp"

namespace orca::hw {

/// A driver of a base at the end of one line: parameters, motion endpoint and description, which all bases have. A driver adds
/// senses, a session, and what poll() and drive() make of both.
///
/// Thread contract: as LineDriver.
class BaseDriver : public LineDriver {
 public:
  std::vector<HardwareFault> prepare() final;
  [[nodiscard]] idl::Robot description() const final;

 protected:
  /// What the bases of a driver have in common. A plain value.
  struct Kind {
    std::string name;                   ///< Default of the parameter `name`.
    DriveLimits usual{};                ///< Its two limits are defaults of parameters.
    std::optional<double> top_speed{};  ///< [m/s] Greatest value of the parameter `max_speed`; nothing: any.
    std::optional<double> top_turn_rate{};  ///< [rad/s] Likewise of `max_turn_rate`.
    std::optional<BaseFigures::Expected>
        in_file{};  ///< What the robot's file should say; nothing: no file is read.
  };

  /// @param usual_line, first  as those of LineDriver.
  BaseDriver(HardwareHost& host, const std::string& usual_line, const link::Line& first, const Kind& kind);

  /// Returns the parameters that a robot's file sets, too. @pre  the kind has a file.
  [[nodiscard]] const BaseFigures& figures() const { return *figures_; }
  /// Returns what the robot's file should say.
  [[nodiscard]] virtual BaseFigures::Expected expected() const { return *kind_.in_file; }
  /// Finds what else is wrong with the parameters. The robot's file has been read.
  virtual void check(std::vector<HardwareFault>& /*faults*/) {}
  /// Returns what the parameters allow; the robot's file may allow less.
  [[nodiscard]] virtual DriveLimits limits() const;
  /// Makes the senses, by parameters without a fault.
  /// @return their endpoints, which live as long as the driver.
  virtual std::vector<SensorEndpoint*> make_senses() = 0;
  /// Completes the description, which has name, drive and senses: maker, model and size, what else is known of the drive, sonars.
  virtual void describe(idl::Robot& robot) const = 0;

  [[nodiscard]] Duration longest_silence() const override { return std::chrono::seconds(1); }
  [[nodiscard]] bool is_active() const { return state() == HardwareState::active; }
  /// Refuses commands to move until an operator lets the base go on, because a person must do something first.
  /// @param reason  what is so, and what to do.
  void await_person(const std::string& reason) { motion()->hold(reason + ", then orcactl estop --release"); }

 private:
  [[nodiscard]] idl::Drive describe_wheels() const;
  [[nodiscard]] std::vector<idl::Sensor> describe_senses() const;

  const Kind kind_;
  Param<std::string> name_;
  Param<double> max_speed_;
  Param<double> max_turn_rate_;
  Param<double> max_command_age_;
  std::optional<BaseFigures> figures_;
  std::optional<MotionHW> motion_;
};

}  // namespace orca::hw
