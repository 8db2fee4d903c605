// SPDX-License-Identifier: LGPL-3.0-or-later
#include <array>
#include <deque>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "orca/hardware.hpp"
#include "orca/hw/base_driver.hpp"
#include "orca/hw/nomad_scout/command.hpp"
#include "scout_senses.hpp"
#include "scout_session.hpp"

namespace {

using namespace orca;
using namespace orca::hw;
using namespace orca::hw::nomad_scout;

constexpr Duration kSayAgain = 250ms;  // what it is to do; its watchdog waits 1 s
constexpr Duration kWatchdog = 1s;     // the shortest that it has
constexpr double kMaxSpeed = 1.0;      // [m/s]
constexpr double kMaxTurnRate = 120.0 * std::numbers::pi / 180.0;
const std::vector<std::uint32_t> kRates{38400, 19200, 9600, 4800};
// The front first, and never two neighbours one after the other behind it.
constexpr std::array<std::uint8_t, kSonars> kSonarOrder{0, 2, 15, 1, 14, 3, 13, 4, 12, 5, 11, 6, 10, 7, 9, 8};

/// A Nomad Scout or Super Scout: a base on two wheels with 16 sonars and a ring of bumpers.
///
/// It is asked for its state, again and again. Its motors get power with the first command to move, not before, and lose it
/// when nobody uses the base and it stands. After a fault they stay off until an operator lets the base move again.
class ScoutBase final : public BaseDriver {
 public:
  explicit ScoutBase(HardwareHost& host)
      : BaseDriver(host, "/dev/ttyUSB0", {.baud = kRates.front()},
                   {.name = "Scout",
                    .usual = {.max_speed = 0.5,
                              .max_turn_rate = 1.5,
                              .big_turn_angle = std::numbers::pi / 3.0,
                              .big_turn_speed = 1.0},
                    .top_speed = kMaxSpeed,
                    .top_turn_rate = kMaxTurnRate,
                    .in_file = {{"Nomad Scout", idl::DIFFERENTIAL, kTrack}}}) {}

 protected:
  std::vector<SensorEndpoint*> make_senses() override {
    senses_.emplace(track(), kSonars * from_seconds(*sonar_interval_), figures().traits());
    return senses_->endpoints();
  }

  void describe(idl::Robot& robot) const override {
    robot.vendor("Nomadics");
    robot.model("SuperScout");
    robot.radius(kRadius);
    robot.bumper_radius(kBumperRadius);
    figures().describe(robot);
    robot.drives().back().speed_change(acceleration());
    robot.sonar_rings().push_back(senses_->describe_sonars());
  }

  LineSession& session() override {
    if (!session_) session_.emplace(line(), kRates);
    return *session_;
  }

  // Its settings may be those of others, and its wheels may turn.
  Status meet() override {
    log_connected("a Nomad Scout", session_->rate());
    rest();
    const bool turns = !(session_->first().state.speeds == Wheels{});
    limp_due_ = turns;
    chores_ = {turns ? nomad_scout::stop() : limp(), set_watchdog(kWatchdog),
               set_accelerations({.left = acceleration(), .right = acceleration()})};
    senses_->connect();
    next_question_ = host().now();
    return ok();
  }

  [[nodiscard]] TimePoint next_turn() const override {
    return session_->is_free() ? next_question_ : session_->next();
  }
  Status start() override {
    senses_->await_sonars(host().now());
    chores_.push_back(start_sonars(from_seconds(*sonar_interval_), kSonarOrder));
    return go_on();
  }

  void stop() override {
    rest();
    chores_.push_back(stop_sonars());
    limp_due_ = true;
    (void)session_->ask(nomad_scout::stop(), host().now());
  }

  // There is no time to wait for answers. Wheels that still turn are held rather than let go.
  void take_leave() override {
    rest();
    (void)session_->tell(nomad_scout::stop());
    (void)session_->tell(stop_sonars());
    if (!senses_->moves()) (void)session_->tell(limp());
    wish_ = {};
  }

  Status poll() override {
    Status heard = ok();
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
  // From now on it is told nothing that moves it.
  void rest() {
    powered_ = false;
    is_told_ = true;
    chores_.clear();
  }

  Status take(const Answer& answer) {
    if (senses_->has_restarted(answer.state))
      return fail(Code::unavailable,
                  "its controller has started anew; was it switched off and on, or is its battery low?");
    heard(answer.stamp);
    note(answer.type);
    senses_->take(answer.state, answer.stamp, wish_.velocity.forward);
    if (!is_active()) return ok();
    motion()->press(senses_->pressed());
    senses_->publish();
    return ok();
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
    if (setpoint.at_once) return ask(nomad_scout::stop());
    return ask(
        nomad_scout::drive(wheels_of(figures().calibration().to_controller(setpoint.velocity), track())));
  }

  [[nodiscard]] double acceleration() const { return figures().within(*max_acceleration_); }
  [[nodiscard]] double track() const {
    const RobotFigures* const file = figures().figures();
    return file != nullptr && *track_ == kTrack ? file->drive.track : *track_;
  }

  Status ask(const Packet& packet) {
    next_question_ = host().now() + kPeriod;
    return session_->ask(packet, host().now());
  }

  Param<double> max_acceleration_{
      *this,
      "max_acceleration",
      0.76,
      {.unit = "m/s2", .min = 0.05, .max = 5.0, .text = "Greatest acceleration of a wheel."}};
  Param<double> track_{*this,
                       "track",
                       kTrack,
                       {.unit = "m",
                        .min = 0.2,
                        .max = 0.5,
                        .text = "Distance between the wheels; measure it by turning. As long as it is "
                                "this one, that of the robot's file counts."}};
  Param<double> sonar_interval_{
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

  std::optional<ScoutSenses> senses_;
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
