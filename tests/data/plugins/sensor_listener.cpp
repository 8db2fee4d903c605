// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"

namespace {

/// Listens to all kinds of sensors of a simulated robot for a while. It is done if each has delivered as many
/// readings as its period implies, each of the right age, and the infrared sensor ahead sees the wall.
class SensorListener final : public orca::Component {
 public:
  explicit SensorListener(orca::ComponentHost& host) : Component(host) { lap_on("odometry"); }

 private:
  static constexpr double kTick = 0.01;  // [s] Readings wait for the end of the simulation's tick.

  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    check_age("odometry", odometry_.get_update()->stamp(), 0.0);
    ++laps_;
    if (laser_.new_data_arrived()) hear_laser();
    if (infrared_.new_data_arrived()) hear_infrared();
    if (bumper_.new_data_arrived()) hear_bumper();
    if (!wrong_.empty()) return orca::failed(wrong_);
    if (laps_ < kLaps) return orca::again();
    return counted("laser", scans_, 10) && counted("infrared", rounds_, 20) && counted("bumper", felt_, 20)
               ? orca::done()
               : orca::failed(wrong_);
  }

  void hear_laser() {
    const auto scan = laser_.get_update();
    ++scans_;
    check_age("laser", scan->stamp(), 180 * scan->time_increment());
    if (scan->ranges().size() != 181) wrong_ = "a scan has " + std::to_string(scan->ranges().size());
  }

  void hear_infrared() {
    const auto round = infrared_.get_update();
    ++rounds_;
    check_age("infrared", round->stamps().at(0), 0.0);
    if (round->ranges().size() != 8 || round->poses().size() != 8) wrong_ = "an infrared round is not of 8";
    // The robot stands close to a wall and faces it.
    if (round->ranges()[0] >= round->max_range()) wrong_ = "the infrared sensor ahead sees nothing";
  }

  void hear_bumper() {
    const auto bumper = bumper_.get_update();
    ++felt_;
    check_age("bumper", bumper->stamp(), 0.0);
    if (bumper->pressed() != std::vector<std::uint8_t>(8)) wrong_ = "a bumper is pressed where nothing is";
  }

  void check_age(const std::string& sensor, const orca::idl::TimeValue& stamp, double expected) {
    const double age = orca::to_seconds(now() - orca::to_time_point(stamp));
    if (age < expected - 1e-6 || age > expected + kTick)
      wrong_ = sensor + " is " + std::to_string(age) + " s old, not " + std::to_string(expected) + " s";
  }

  bool counted(const std::string& sensor, int readings, int expected) {
    if (std::abs(readings - expected) <= 1) return true;
    wrong_ = sensor + " gave " + std::to_string(readings) + " readings in a second";
    return false;
  }

  static constexpr int kLaps = 100;

  orca::PushProxy<orca::idl::Odometry> odometry_{*this, "odometry"};
  orca::PushProxy<orca::idl::LaserRangeReadings> laser_{*this, "laser"};
  orca::PushProxy<orca::idl::InfraredRangeReadings> infrared_{*this, "infrared"};
  orca::PushProxy<orca::idl::BumperReadings> bumper_{*this, "bumper"};
  int laps_ = 0;
  int scans_ = 0;
  int rounds_ = 0;
  int felt_ = 0;
  std::string wrong_;
};

}  // namespace

ORCA_COMPONENT(SensorListener, "test.SensorListener")
