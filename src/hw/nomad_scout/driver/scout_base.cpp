// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "orca/hardware.hpp"
#include "orca/hw/base_figures.hpp"
#include "orca/hw/line_driver.hpp"
#include "orca/hw/line_frames.hpp"
#include "orca/hw/nomad_scout/command.hpp"
#include "scout_senses.hpp"
#include "scout_session.hpp"

namespace {

using orca::Duration;
using orca::Result;
using orca::Status;
using orca::TimePoint;
using orca::hw::DriveSetpoint;
using namespace orca::hw::nomad_scout;
using namespace std::chrono_literals;

constexpr Duration kSayAgain = 250ms;  // what it is to do; its watchdog waits 1 s
constexpr Duration kWatchdog = 1s;     // the shortest that it has
constexpr double kMaxSpeed = 1.0;      // [m/s]
constexpr double kMaxTurnRate = 120.0 * std::numbers::pi / 180.0;
const std::vector<std::uint32_t> kRates{38400, 19200, 9600, 4800};
// The front first, and never two neighbours one after the other behind it.
constexpr std::array<std::uint8_t, kSonars> kSonarOrder{0, 2, 15, 1, 14, 3, 13, 4, 12, 5, 11, 6, 10, 7, 9, 8};

Duration as_duration(double seconds) { return Duration(std::llround(1e9 * seconds)); }

/// A Nomad Scout or Super Scout: a base on two wheels with 16 sonars and a ring of bumpers.
///
/// It is asked for its state, again and again. Its motors get power with the first command to move, not before, and lose it
/// when nobody uses the base and it stands. After a fault they stay off until an operator lets the base move again.
class ScoutBase final : public orca::hw::LineDriver {
 public:
  explicit ScoutBase(orca::hw::HardwareHost& host)
      : LineDriver(host, "/dev/ttyUSB0", {.baud = kRates.front()}) {}

  std::vector<orca::HardwareFault> prepare() override {
    std::vector<orca::HardwareFault> faults = prepare_line();
    for (orca::HardwareFault& fault : base_.read({"Nomad Scout", orca::idl::DIFFERENTIAL, kTrack}))
      faults.push_back(std::move(fault));
    if (orca::hw::any_refuses(faults)) return faults;
    senses_.emplace(track(), kSonars * as_duration(*sonar_interval_));
    senses_->describe(base_.traits());
    for (orca::hw::SensorEndpoint* const sensor : senses_->endpoints()) add_sensor(*sensor);
    motion_.emplace(base_.within({.max_speed = *max_speed_,
                                  .max_turn_rate = *max_turn_rate_,
                                  .steer_gain = 2.0,
                                  .big_turn_angle = std::numbers::pi / 3.0,
                                  .big_turn_speed = 1.0}),
                    base_.max_command_age());
    set_motion(*motion_);
    return faults;
  }

  [[nodiscard]] orca::idl::Robot description() const override {
    orca::idl::Robot robot;
    robot.name(*name_);
    robot.vendor("Nomadics");
    robot.model("SuperScout");
    robot.radius(kRadius);
    robot.bumper_radius(kBumperRadius);
    base_.describe(robot);
    robot.drives().push_back(describe_wheels());
    robot.drives().back().speed_change(acceleration());
    robot.sensors() = describe_senses();
    robot.sonar_rings().push_back(senses_->describe_sonars());
    return robot;
  }

 protected:
  Status begin(TimePoint now) override {
    session_.emplace(line(), has_rate() ? kRates : std::vector<std::uint32_t>{kRates.front()});
    return session_->begin(now);
  }

  Result<bool> advance(TimePoint now) override {
    Result<bool> done = session_->advance(now);
    if (!done || !*done) return done;
    meet(now);
    return true;
  }

  [[nodiscard]] TimePoint next_step() const override { return session_->deadline(); }
  [[nodiscard]] TimePoint next_turn() const override {
    return session_->is_free() ? next_question_ : session_->deadline();
  }
  [[nodiscard]] orca::hw::LineCounts counts() const override {
    return orca::hw::counts_of(session_->statistics());
  }
  [[nodiscard]] Duration longest_silence() const override { return 1s; }

  Status start() override {
    senses_->await_sonars(host().now());
    chores_.push_back(start_sonars(as_duration(*sonar_interval_), kSonarOrder));
    return go_on();
  }

  void stop() override {
    rest();
    chores_.push_back(stop_sonars());
    limp_due_ = true;
    (void)session_->ask(orca::hw::nomad_scout::stop(), host().now());
  }

  // There is no time to wait for answers. Wheels that still turn are held rather than let go.
  void take_leave() override {
    rest();
    (void)session_->tell(orca::hw::nomad_scout::stop());
    (void)session_->tell(stop_sonars());
    if (!senses_->moves()) (void)session_->tell(limp());
    wish_ = {};
  }

  Status poll() override {
    Status heard = orca::ok();
    const Status read = session_->receive(host().now(), [&](const Answer& answer) {
      if (heard.ok()) heard = take(answer);
    });
    if (!read.ok()) return read;
    return heard.ok() ? go_on() : heard;
  }

  // An emergency does not wait for the answer to an earlier command.
  Status drive(const DriveSetpoint& setpoint) override {
    wish_ = setpoint;
    if (!setpoint.stands()) powered_ = true;
    is_told_ = !powered_;  // there is nothing to tell to motors that are limp
    if (powered_) limp_due_ = false;
    return setpoint.at_once && powered_ ? say(wish_) : go_on();
  }

 private:
  // The robot has answered. Its settings may be those of others, and its wheels may turn.
  void meet(TimePoint now) {
    host().write_log(orca::log::Level::info,
                     "connected to a Nomad Scout" +
                         (has_rate() ? " at " + std::to_string(session_->rate()) + " baud" : std::string()));
    rest();
    const bool turns = !(session_->first().state.speeds == Wheels{});
    limp_due_ = turns;
    chores_ = {turns ? orca::hw::nomad_scout::stop() : limp(), set_watchdog(kWatchdog),
               set_accelerations({.left = acceleration(), .right = acceleration()})};
    senses_->connect();
    next_question_ = now;
  }

  // From now on it is told nothing that moves it.
  void rest() {
    powered_ = false;
    is_told_ = true;
    chores_.clear();
  }

  Status take(const Answer& answer) {
    if (senses_->has_restarted(answer.state))
      return orca::fail(
          orca::Code::unavailable,
          "its controller has started anew; was it switched off and on, or is its battery low?");
    heard(answer.stamp);
    note(answer.type);
    senses_->take(answer.state, answer.stamp, wish_.velocity.forward);
    if (state() != orca::hw::HardwareState::active) return orca::ok();
    motion_->press(senses_->pressed());
    senses_->publish();
    return orca::ok();
  }

  // Each answer names the command that it answers.
  void note(Type answered) {
    if ((answered == Type::drive || answered == Type::stop) && said_ == wish_) is_told_ = true;
    if (answered == Type::limp) limp_due_ = false;
    if (!chores_.empty() && answered == message_of(chores_.front().view()).type) chores_.pop_front();
  }

  // Says the next thing if the robot has answered the last one.
  Status go_on() {
    const TimePoint now = host().now();
    if (!session_->is_free() || (is_told_ && chores_.empty() && now < next_question_)) return line().flush();
    const bool is_unsure = powered_ && (!wish_.stands() || senses_->moves());
    if (!is_told_ || (is_unsure && now >= say_again_)) return say(wish_);
    if (!chores_.empty()) return ask(chores_.front());
    if (limp_due_ && !senses_->moves()) return ask(limp());
    return ask(get_state());
  }

  Status say(const DriveSetpoint& setpoint) {
    said_ = setpoint;
    say_again_ = host().now() + kSayAgain;
    if (setpoint.at_once) return ask(orca::hw::nomad_scout::stop());
    return ask(orca::hw::nomad_scout::drive(
        wheels_of(base_.calibration().to_controller(setpoint.velocity), track())));
  }

  [[nodiscard]] double acceleration() const { return base_.within(*max_acceleration_); }
  [[nodiscard]] double track() const {
    const orca::hw::RobotFigures* const file = base_.figures();
    return file != nullptr && *track_ == kTrack ? file->wheels->track : *track_;
  }

  Status ask(const Packet& packet) {
    next_question_ = host().now() + kPeriod;
    return session_->ask(packet, host().now());
  }

  orca::Param<std::string> name_{*this, "name", "Scout", {.text = "Name of this robot, one word."}};
  orca::Param<double> max_speed_{
      *this, "max_speed", 0.5, {.unit = "m/s", .min = 0.0, .max = kMaxSpeed, .text = "Greatest speed."}};
  orca::Param<double> max_turn_rate_{
      *this,
      "max_turn_rate",
      1.5,
      {.unit = "rad/s", .min = 0.0, .max = kMaxTurnRate, .text = "Greatest turn rate."}};
  orca::Param<double> max_acceleration_{
      *this,
      "max_acceleration",
      0.76,
      {.unit = "m/s2", .min = 0.05, .max = 5.0, .text = "Greatest acceleration of a wheel."}};
  orca::Param<double> track_{*this,
                             "track",
                             kTrack,
                             {.unit = "m",
                              .min = 0.2,
                              .max = 0.5,
                              .text = "Distance between the wheels; measure it by turning. As long as it is "
                                      "this one, that of the robot's file counts."}};
  orca::Param<double> sonar_interval_{
      *this,
      "sonar_interval",
      0.012,
      {.unit = "s",
       .min = 0.004,
       .max = 1.0,
       .text = "Time from one sonar's firing to that of the next, in steps of 4 ms. Below 0.04 a sonar may "
               "hear the "
               "one before it, which fires in another direction; with 16 sonars above 0.015, SonarAvoid has "
               "forgotten an echo before the next one comes."}};
  orca::hw::BaseFigures base_{*this};

  std::optional<ScoutSenses> senses_;
  std::optional<orca::hw::MotionHW> motion_;
  std::optional<ScoutSession> session_;
  std::deque<Packet> chores_;  // settings that it is still to be told
  bool powered_ = false;       // the motors
  bool limp_due_ = false;      // they are to be limp as soon as the wheels stand
  DriveSetpoint wish_;         // what the wheels are to do
  DriveSetpoint said_;         // what they were told last
  bool is_told_ = true;        // whether it has answered to the wish
  TimePoint say_again_{};
  TimePoint next_question_{};
};

}  // namespace

ORCA_HARDWARE(ScoutBase, "orca.hw.NomadScout")
