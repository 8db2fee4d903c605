// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>

#include <functional>
#include <map>
#include <sstream>

#include "diary.hpp"
#include "executives.hpp"
#include "orca/hw/container.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"

namespace orca::test {

/// The host of a container: keeps the container's states and errors as lines of a diary.
class FakeHardwareHost final : public hw::HardwareHost {
 public:
  FakeHardwareHost(Executive& executive, Diary& diary) : executive_(executive), diary_(diary) {}

  void declare_param(ParamDeclaration declaration) override { params_.push_back(std::move(declaration)); }
  /// Sets a parameter of the container.
  void set(const std::string& param, const ParamValue& value) const {
    for (const ParamDeclaration& each : params_)
      if (each.contract.name == param) each.set(value);
  }
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] TimePoint now() const override { return executive_.now(); }
  [[nodiscard]] RandomStream random(std::string_view stream) const override { return {1, name_, stream}; }
  void write_log(log::Level /*level*/, std::string_view text) const override {
    diary_.note("log: " + std::string(text));
  }
  void report(const idl::Contact& /*contact*/) override {}
  [[nodiscard]] std::uint64_t run_seed() const override { return 1; }
  void state_changed(hw::HardwareState state) override { diary_.note(std::string("-> ") + to_string(state)); }
  void held(const std::optional<std::string>& reason) override {
    diary_.note(reason ? "held: " + *reason : "obeys again");
  }
  void pausing() override {}
  [[nodiscard]] Executive& executive() override { return executive_; }

 private:
  Executive& executive_;
  Diary& diary_;
  std::string name_ = "scout";
  std::vector<ParamDeclaration> params_;
};

inline constexpr hw::DriveLimits kScoutLimits{
    .max_speed = 1.0, .max_turn_rate = 2.0, .steer_gain = 0.5, .big_turn_angle = 1.0, .big_turn_speed = 0.2};
inline constexpr Duration kScoutCommandAge = 200ms;

/// A Nomad Scout without a device: sonars, odometry, wheels, and a turret if it is to have one. Notes every call of the driver's
/// functions, and fails in them on request.
class FakeScout : public hw::HardwareContainer {
 public:
  /// Called at the start of the driver's function of that name.
  std::map<std::string, std::function<Status()>> trouble;

  explicit FakeScout(hw::HardwareHost& host, Diary& diary, const hw::DriveLimits& limits = kScoutLimits,
                     bool has_turret = false)
      : HardwareContainer(host), diary_(diary), wheels_(limits, kScoutCommandAge) {
    add_sensor(sonar_);
    add_sensor(odometry_);
    set_motion(wheels_);
    if (has_turret) add_actuator(turret_);
  }

  std::vector<orca::HardwareFault> prepare() override { return {}; }
  [[nodiscard]] idl::Robot description() const override { return {}; }
  [[nodiscard]] hw::MotionHW& wheels() { return wheels_; }

 protected:
  Status open() override { return act("open"); }
  Status start() override { return act("start"); }
  void stop() override { (void)act("stop"); }
  void close() override { (void)act("close"); }
  Status drive(const hw::DriveSetpoint& setpoint) override {
    std::ostringstream line;
    line << "drive " << setpoint.velocity.forward << " " << setpoint.velocity.turn_rate;
    if (wheels_.limits().type == idl::HOLONOMIC) line << " left " << setpoint.velocity.left;
    diary_.note(line.str());
    return meet_trouble("drive");
  }

  Status poll() override {
    next_poll_ = host().now() + 50ms;
    if (Status met = meet_trouble("poll"); !met.ok()) return met;
    if (state() != hw::HardwareState::active) return ok();
    auto odometry = odometry_.loan();
    odometry->x(++x_);
    odometry->stamp(to_time_value(host().now()));
    odometry_.publish(std::move(odometry));
    auto sonar = sonar_.loan();
    sonar->ranges().assign(16, 2.0);
    sonar_.publish(std::move(sonar));
    return ok();
  }
  [[nodiscard]] TimePoint next_poll() const override { return next_poll_; }

 private:
  Status act(const std::string& function) {
    diary_.note(function);
    return meet_trouble(function);
  }
  Status point(const idl::TurretCommand& turret) {
    std::ostringstream line;
    line << "turret " << turret.angle();
    diary_.note(line.str());
    return meet_trouble("turret");
  }
  Status meet_trouble(const std::string& function) {
    const auto found = trouble.find(function);
    return found != trouble.end() ? found->second() : ok();
  }

  Diary& diary_;
  hw::SensorHW<idl::SonarRangeReadings> sonar_{50ms};
  hw::SensorHW<idl::Odometry> odometry_{50ms};
  hw::MotionHW wheels_;
  hw::ActuatorHW<idl::TurretCommand> turret_{{.act = [this](const auto& turret) { return point(turret); },
                                              .halt = [this] { return act("halt turret"); }}};
  TimePoint next_poll_{};
  double x_ = 0.0;
};

/// A scout whose strand runs as long as this lives.
struct RunningScout {
  explicit RunningScout(Executive& used) : RunningScout(used, {}) {}
  RunningScout(Executive& used, std::map<std::string, std::function<Status()>> trouble,
               const hw::DriveLimits& limits = kScoutLimits, bool has_turret = false)
      : executive(used), host(used, diary), scout(host, diary, limits, has_turret) {
    scout.trouble = std::move(trouble);
    scout.run();
  }
  ~RunningScout() { end(); }

  void end() {
    scout.shut_down();
    CHECK(scout.join_until(executive.now() + 5s));
  }

  [[nodiscard]] bool gets(hw::HardwareState state) {
    return eventually(executive, [&] { return scout.state() == state; });
  }
  [[nodiscard]] bool notes(const std::string& line) {
    return eventually(executive, [&] { return diary.has(line); });
  }

  Executive& executive;
  Diary diary;
  FakeHardwareHost host;
  FakeScout scout;
};

}  // namespace orca::test
