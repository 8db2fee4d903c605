// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "create2_senses.hpp"
#include "create2_session.hpp"
#include "orca/hardware.hpp"
#include "orca/hw/base_driver.hpp"

namespace {

using namespace orca;
using namespace orca::hw;
using namespace orca::hw::create2;

constexpr Duration kSayAgain = 250ms;
constexpr Duration kStopTime = 1s;      // for which it is told to stop, again and again, when it is held
constexpr Duration kCliffTime = 200ms;  // in which the end of safe mode is put down to a cliff
constexpr double kMaxTurnRate = 2.0 * kMaxWheelSpeed / kWheelBase;
const std::vector<std::uint32_t> kRates{115200, 19200};

/// An iRobot Create 2, or a Roomba of the series 600: a base on two wheels with a bumper and cliff sensors.
///
/// It enters safe mode, in which its motors may run, with the first command to move, and is in passive mode before and when nobody
/// uses it. It leaves safe mode by itself when a wheel hangs, at a cliff and at a charger. It has no watchdog: when the
/// line breaks while it drives, it drives on until its bumper, which it does not heed, or a cliff.
class Create2Base final : public BaseDriver {
 public:
  explicit Create2Base(HardwareHost& host)
      : BaseDriver(host, "/dev/ttyUSB0", {.baud = kRates.front()},
                   {.name = "Create",
                    .usual = {.max_speed = 0.3,
                              .max_turn_rate = 1.5,
                              .big_turn_angle = std::numbers::pi / 3.0,
                              .big_turn_speed = 0.1},
                    .top_speed = kMaxWheelSpeed,
                    .top_turn_rate = kMaxTurnRate,
                    .in_file = {{"Create 2", idl::DIFFERENTIAL, kWheelBase}}}) {}

 protected:
  std::vector<SensorEndpoint*> make_senses() override {
    senses_.emplace(figures().traits());
    return senses_->endpoints();
  }

  void describe(idl::Robot& robot) const override {
    robot.vendor("iRobot");
    robot.model("Create 2");
    robot.radius(kRadius);
    robot.bumper_radius(kRadius);
    figures().describe(robot);
  }

  LineSession& session() override {
    if (!session_) session_.emplace(line(), kRates);
    return *session_;
  }

  Status meet() override {
    log_connected("a Create 2", session_->rate());
    senses_->connect();
    rest();
    return ok();
  }

  [[nodiscard]] TimePoint next_turn() const override {
    return powered_ || say_again_ < stops_until_ ? say_again_ : kForever;
  }

  void stop() override {
    (void)session_->send(drive_wheels({}));
    (void)session_->send(encode(Order::start));  // back to passive mode
    rest();
  }

  void take_leave() override {
    (void)session_->send(drive_wheels({}));
    (void)session_->send(encode(Order::stop));
    rest();
  }

  Status poll() override {
    const TimePoint now = host().now();
    const auto taken = [this](const Sensors& sensors, TimePoint stamp) { take(sensors, stamp); };
    if (Status read = session_->receive(now, taken); !read.ok()) return read;
    if (!is_told() || now < say_again_) return line().flush();
    return say(applied_);
  }

  Status drive(const DriveSetpoint& setpoint) override {
    applied_ = setpoint;
    if (!setpoint.stands()) powered_ = true;
    return is_told() ? say(setpoint) : ok();
  }

 private:
  // From now on it is told nothing that moves it.
  void rest() {
    powered_ = was_safe_ = false;
    applied_ = {};
  }

  void take(const Sensors& sensors, TimePoint stamp) {
    heard(stamp);
    senses_->take(sensors, stamp);
    if (!is_active()) return;
    guard();
    senses_->publish();
    if (const std::string remark = senses_->take_remark(); !remark.empty()) warn(remark);
  }

  // Stops the base where it cannot go on. What needs a person needs an operator to go on.
  void guard() {
    const std::vector<Obstruction::Pressed> pressed = senses_->pressed();
    if (!pressed.empty()) last_cliff_ = host().now();
    motion()->press(pressed);
    const Sensors& sensors = senses_->sensors();
    const bool is_safe = sensors.mode == Mode::safe;
    if (sensors.is_stalled) motion()->obstruct("its motors draw too much current", Hindrance::stall);
    if (sensors.bumps_and_drops.drop_left || sensors.bumps_and_drops.drop_right)
      hold("a wheel hangs; put it down on the floor");
    if (powered_ && sensors.is_at_charger) hold("it is connected to its charger; take it off");
    if (is_safe) was_safe_ = powered_;
    if (!was_safe_ || is_safe) return;
    was_safe_ = false;  // at a cliff; the next command to move takes it into safe mode again
    if (host().now() - last_cliff_ > kCliffTime)
      hold("it has left safe mode; was one of its buttons pressed?");
  }

  // It may go on with what it was told last, whatever it says of itself: so it is told to stop before nothing more is said.
  void hold(const std::string& reason) {
    if (powered_) {
      stops_until_ = host().now() + kStopTime;
      say_again_ = host().now();
    }
    rest();
    await_person(reason);
  }

  // Whether it is told what its wheels are to do.
  [[nodiscard]] bool is_told() const { return powered_ || host().now() < stops_until_; }

  // Safe mode is asked for again until it is there, but not to stand.
  Status say(const DriveSetpoint& setpoint) {
    say_again_ = host().now() + kSayAgain;
    if (!setpoint.stands() && senses_->sensors().mode != Mode::safe)
      if (Status safe = session_->send(encode(Order::safe)); !safe.ok()) return safe;
    return session_->send(
        drive_wheels(wheel_speeds(figures().calibration().to_controller(setpoint.velocity))));
  }

  std::optional<Create2Senses> senses_;
  std::optional<Create2Session> session_;
  bool powered_ = false;   // it was told to move since it was connected, stopped or held
  bool was_safe_ = false;  // it has entered safe mode since then
  DriveSetpoint applied_;  // what the wheels were told last
  TimePoint say_again_{};
  TimePoint stops_until_{};  // it is told to stop although it is held
  TimePoint last_cliff_{};   // or bumper
};

}  // namespace

ORCA_HARDWARE(Create2Base, "orca.hw.Create2")
