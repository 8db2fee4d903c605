// SPDX-License-Identifier: LGPL-3.0-or-later
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "objects.hpp"
#include "orca/hardware.hpp"
#include "own_sight.hpp"
#include "sim_sensors.hpp"
#include "simulated_robot.hpp"
#include "touch_guard.hpp"

namespace {

using namespace orca::sim;
using orca::Status;
using orca::TimePoint;

// Longest time that a motion command holds (DESIGN 11).
constexpr orca::Duration kMaxCommandAge = std::chrono::milliseconds(200);
constexpr GripperOrder kHaltGripper{Paddles::halt, Lift::halt};

/// A robot in the simulated world, behind the same interface as real hardware.
class SimHardware final : public SimulatedRobot {
 public:
  using SimulatedRobot::SimulatedRobot;

 private:
  using Turret = orca::hw::ActuatorHW<orca::idl::TurretCommand>;
  using Gripper = orca::hw::ActuatorHW<orca::idl::GripperCommand>;

  std::vector<orca::HardwareFault> declare() override {
    std::vector<orca::HardwareFault> faults;
    declare_endpoints();
    for (const std::string& gap : gaps_at_own_sensors(robot()))
      faults.push_back({.param = "robot", .text = gap, .only_warns = true});
    return faults;
  }

  void declare_endpoints() {
    sensors_ = std::make_unique<SimSensors>(robot(), realism());
    for (orca::hw::SensorEndpoint* endpoint : sensors_->endpoints()) add_sensor(*endpoint);
    if (robot().fixed) return;
    motion_ = std::make_unique<orca::hw::MotionHW>(limits_of(robot()), kMaxCommandAge);
    set_motion(*motion_);
    if (*stop_on_touch_) guard_.emplace(robot(), *motion_);
    declare_actuators();
  }

  void declare_actuators() {
    if (robot().turret) {
      turret_ = std::make_unique<Turret>(Turret::Driver{
          .act = [this](const orca::idl::TurretCommand& turret) { return point_turret(turret.angle()); }});
      add_actuator(*turret_);
    }
    if (robot().gripper) {
      gripper_ = std::make_unique<Gripper>(Gripper::Driver{
          .act = [this](const orca::idl::GripperCommand& command) { return move_gripper(order_of(command)); },
          .halt = [this] { return move_gripper(kHaltGripper); }});
      add_actuator(*gripper_);
    }
  }

  Status drive(const orca::hw::DriveSetpoint& setpoint) override {
    if (guard_) guard_->driven(setpoint.velocity, host().now());
    return command(setpoint);
  }

  [[nodiscard]] TimePoint next_poll() const override { return next_tick(); }

  Status poll() override {
    go_on();
    return orca::ok();
  }

  void sense(const SharedWorld::Inbox& inbox) override {
    if (guard_) guard_->look(inbox);
    if (state() == orca::hw::HardwareState::active) {
      sensors_->publish(robot().fixed ? in_world(inbox, start()) : inbox);
    } else {
      sensors_->skip(inbox);
    }
  }

  void miss(const SharedWorld::Inbox& inbox) override { sensors_->skip(inbox); }

  orca::Param<bool> stop_on_touch_{
      *this,
      "stop_on_touch",
      true,
      {.fixed = true,
       .text = "Whether the base stands while a bumper is pressed (without bumpers: "
               "after it has touched something), or when its motors "
               "are stalled, until a command asks for another direction."}};
  std::unique_ptr<SimSensors> sensors_;
  std::unique_ptr<orca::hw::MotionHW> motion_;
  std::unique_ptr<Turret> turret_;
  std::unique_ptr<Gripper> gripper_;
  std::optional<TouchGuard> guard_;
};

}  // namespace

ORCA_HARDWARE(SimHardware, "orca.hw.Sim")
