// SPDX-License-Identifier: GPL-3.0-or-later
// A driver in several versions, made of this file with different definitions:
//   CART_VERSION  number that it says with what it does
//   CART_ODD      whether it is another kind of base, with another sensor and without gripper
#include <cmath>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include "orca/hardware.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"

#ifndef CART_ODD
#define CART_ODD 0
#endif

namespace {

using orca::Duration;
using orca::Status;
using std::chrono::milliseconds;

constexpr Duration kStep = milliseconds(10);
constexpr Duration kPeriod = milliseconds(CART_ODD != 0 ? 100 : 50);

/// A cart that goes exactly as it is told. It is where it was left, if its file says where.
class Cart final : public orca::hw::HardwareContainer {
 public:
  using HardwareContainer::HardwareContainer;

 private:
  std::vector<orca::HardwareFault> prepare() override {
    if (*trouble_ == "prepare") return {{"trouble", "is not liked today"}, {"speed", "is not liked either"}};
    if (*trouble_ == "sleep") std::this_thread::sleep_for(std::chrono::hours(24));
    for (volatile bool spins = *trouble_ == "spin"; spins;) continue;
    orca::hw::DriveLimits limits{.max_speed = *speed_, .max_turn_rate = 2.0, .steer_gain = 1.0};
    if (CART_ODD != 0) limits.type = orca::idl::HOLONOMIC;
    motion_.emplace(limits, milliseconds(200));
    set_motion(*motion_);
    add_sensor(odometry_);
    if (CART_ODD == 0) add_sensor(bumper_);
    if (CART_ODD == 0) add_actuator(gripper_);
    return {};
  }

  [[nodiscard]] orca::idl::Robot description() const override {
    orca::idl::Robot robot;
    robot.name() = "cart";
    orca::idl::Drive drive;
    drive.name() = CART_ODD != 0 ? "mecanum" : "wheels";
    drive.max_speed(*speed_);
    robot.drives().push_back(drive);
    return robot;
  }

  Status open() override {
    say("open");
    if (*trouble_ == "throw") throw std::runtime_error("no cart today");
    if (*trouble_ == "block") std::this_thread::sleep_for(milliseconds(1000));  // of this, Orca knows nothing
    if (*trouble_ == "open" || *trouble_ == "block" || (*trouble_ == "reopen" && was_open_))
      return orca::fail(orca::Code::unavailable, "the cable is off");
    if (*trouble_ == "wait") wait(milliseconds(1500));
    if (*trouble_ == "hang") wait(milliseconds(6000));
    was_open_ = true;
    if (std::ifstream file(*file_); file) file >> x_ >> y_ >> yaw_;
    next_ = next_reading_ = host().now();
    return orca::ok();
  }

  Status start() override {
    say("start");
    return *trouble_ == "start" ? orca::fail(orca::Code::unavailable, "the motors are hot") : orca::ok();
  }

  void stop() override { say("stop"); }

  void close() override {
    say("close");
    if (*trouble_ == "close") wait(milliseconds(4000));
    if (!file_->empty()) std::ofstream(*file_) << x_ << ' ' << y_ << ' ' << yaw_ << '\n';
  }

  Status drive(const orca::hw::DriveSetpoint& setpoint) override {
    velocity_ = setpoint.velocity;
    say(setpoint.stands() ? (setpoint.at_once ? "stops at once" : "stops") : "moves");
    return orca::ok();
  }

  [[nodiscard]] orca::TimePoint next_poll() const override { return next_; }

  Status poll() override {
    next_ += kStep;
    const double time = orca::to_seconds(kStep);
    yaw_ += time * velocity_.turn_rate;
    x_ += time * velocity_.forward * std::cos(yaw_);
    y_ += time * velocity_.forward * std::sin(yaw_);
    if (state() == orca::hw::HardwareState::active && host().now() >= next_reading_) publish();
    return orca::ok();
  }

  void publish() {
    next_reading_ += kPeriod;
    auto odometry = odometry_.loan();
    odometry->x(x_);
    odometry->y(y_);
    odometry->steer_angle(std::remainder(yaw_, 2.0 * M_PI));
    odometry->translational_velocity(velocity_.forward);
    odometry->steering_velocity(velocity_.turn_rate);
    odometry->covariance(
        {1e-4, 0.0, 0.0, 0.0, 1e-4, 0.0, 0.0, 0.0, 1e-4});  // a hundredth of a metre and of a radian
    odometry->stamp(orca::to_time_value(host().now()));
    odometry_.publish(std::move(odometry));
  }

  // Does nothing for that long, as a driver whose device does not answer.
  void wait(Duration time) {
    const auto silence = host().executive().make_event();
    (void)silence->wait_until(host().now() + time);
  }

  void say(const std::string& what) const {
    host().write_log(orca::log::Level::debug, "cart " + std::to_string(CART_VERSION) + " " + what);
  }

  orca::Param<double> speed_{
      *this, "speed", 0.5, {.unit = "m/s", .min = 0.0, .max = CART_VERSION == 1 ? 2.0 : 1.0}};
  orca::Param<std::string> file_{*this, "file", "", {.text = "Where it keeps its place while it is closed."}};
  orca::Param<std::string> trouble_{*this,
                                    "trouble",
                                    "none",
                                    {.choices = {"none", "prepare", "sleep", "spin", "open", "reopen",
                                                 "throw", "wait", "block", "hang", "start", "close"}}};

  std::optional<orca::hw::MotionHW> motion_;
  orca::hw::SensorHW<orca::idl::Odometry> odometry_{kPeriod};
  orca::hw::SensorHW<orca::idl::BumperReadings> bumper_{kPeriod};
  orca::hw::ActuatorHW<orca::idl::GripperCommand> gripper_{{.act = [](const auto&) { return orca::ok(); }}};
  orca::Twist2 velocity_{};
  double x_ = 0.0;  // [m]
  double y_ = 0.0;
  double yaw_ = 0.0;  // [rad]
  bool was_open_ = false;
  orca::TimePoint next_;
  orca::TimePoint next_reading_;
};

}  // namespace

ORCA_HARDWARE(Cart, "test.Cart")
