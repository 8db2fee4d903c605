// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/hardware.hpp"
#include "orca/hw/base_driver.hpp"
#include "orca/hw/xr4000/request.hpp"
#include "xr4000_senses.hpp"
#include "xr4000_session.hpp"

namespace {

using namespace orca;
using namespace orca::hw;
using namespace orca::hw::xr4000;

constexpr Duration kSayAgain = 250ms;     // what the axes are to do
constexpr Duration kFeedPeriod = 100ms;   // of the motion timer
constexpr Duration kLimpAfter = 500ms;    // that the motion timer was fed last
constexpr Duration kAfterRefusal = 50ms;  // in which the next state says why
constexpr int kRefusals = 20;             // of N_SetAxes one after the other until we give up
constexpr Axes kHardest{kMaxAcceleration, kMaxAcceleration, kMaxTurnAcceleration};

/// A Nomad XR4000, a round base that drives in every direction, with 48 sonars and bumpers. The driver talks to an agent on the
/// robot's computer, which calls the robot's client library (docs/hardware/xr4000.md).
///
/// Its axes are told nothing before the first command to move. When nobody uses the base, and after a fault, its motion timer is
/// fed no more, so that they go limp. After a fault they stay so until an operator lets the base move again.
///
/// Infrared readings are not published: no public source says how the library's count becomes a distance.
class Xr4000Base final : public BaseDriver {
 public:
  explicit Xr4000Base(HardwareHost& host)
      : BaseDriver(host, "/dev/ttyUSB0", {.baud = 115200},
                   {.name = "Nomad",
                    .usual = {.max_speed = 0.5,
                              .max_turn_rate = 0.5,
                              .steer_gain = 1.0,
                              .big_turn_angle = std::numbers::pi / 3.0,
                              .big_turn_speed = 0.1,
                              .type = idl::HOLONOMIC},
                    .top_speed = 0.001 * kMaxSpeed,
                    .top_turn_rate = 0.001 * kMaxTurnRate,
                    .in_file = {{"Nomad XR4000", idl::HOLONOMIC}}}) {}

 protected:
  std::vector<SensorEndpoint*> make_senses() override {
    senses_.emplace(from_seconds(*sonar_cycle_),
                    XrSenses::BatteryScale{*battery_scale_, static_cast<std::size_t>(*battery_channel_)},
                    figures().traits());
    return senses_->endpoints();
  }

  void describe(idl::Robot& robot) const override {
    robot.vendor("Nomadic Technologies");
    robot.model("XR4000");
    robot.radius(*radius_);
    robot.bumper_radius(*radius_);
    if (*radius_ == kBodyRadius) figures().describe(robot);
    robot.drives().back().speed_change(figures().within(*max_acceleration_));
    robot.sonar_rings().push_back(senses_->describe_sonars());
  }

  LineSession& session() override {
    if (!session_) session_.emplace(line());
    return *session_;
  }

  // The robot's settings may be those of others, and its axes may move.
  Status meet() override {
    log_connected("the agent of an XR4000");
    rest();
    wants_stop_ = true;
    refusals_ = 0;
    complaint_.clear();
    senses_->connect();
    has_timer_ = false;
    const TimePoint now = host().now();
    questions_ = {{Type::get_state, kReadingPeriod, now},
                  {Type::get_bumper, kReadingPeriod, now},
                  {Type::get_sonar, kReadingPeriod, now}};
    if (senses_->has_battery()) questions_.push_back({Type::get_battery, kBatteryPeriod, now});
    return ok();
  }

  [[nodiscard]] TimePoint next_turn() const override {
    if (!session_->is_free()) return session_->next();
    TimePoint next = powered_ ? feed_at_ : kForever;
    if (must_say()) next = std::min(next, say_at_);
    for (const Question& question : questions_) next = std::min(next, question.next);
    return next;
  }
  void stop() override {
    const bool brakes = powered_ || senses_->moves();
    rest();
    if (brakes) (void)session_->ask(drive_axes({.at_once = true}), host().now());
  }

  // There is no time to wait for an answer. The axes go limp when the motion timer has run out.
  void take_leave() override {
    if (powered_ || (senses_->moves() && is_ready())) (void)session_->tell(drive_axes({.at_once = true}));
    rest();
    wish_ = {};
  }

  Status poll() override {
    Status heard = ok();
    const Status read = session_->receive(host().now(), [&](const Message& answer, TimePoint stamp) {
      if (heard.ok()) heard = take(answer, stamp);
    });
    if (!read.ok()) return read;
    return heard.ok() ? go_on() : heard;
  }

  // An emergency does not wait for the answer to an earlier request.
  Status drive(const DriveSetpoint& setpoint) override {
    wish_ = setpoint;
    if (!setpoint.stands() && !powered_) {
      powered_ = true;
      feed_at_ = host().now();
    }
    is_told_ = !powered_;  // there is nothing to tell to axes that are limp
    say_at_ = host().now();
    if (setpoint.at_once && powered_) return session_->ask(say(host().now()), host().now());
    return go_on();
  }

 private:
  // What is asked again and again.
  struct Question {
    Type type;
    Duration period;
    TimePoint next{};
  };

  // From now on it is told nothing that moves it, and its motion timer is not fed.
  void rest() {
    powered_ = false;
    is_told_ = true;
    wants_stop_ = brakes_ = false;
  }

  Status take(const Message& answer, TimePoint stamp) {
    switch (answer.type) {
      case Type::get_state: return take_state(answer, stamp);
      case Type::set_axes: return take_told(answer);
      case Type::reset_motion_timer:
      case Type::set_timer: return take_timer(answer);
      default: return take_readings(answer, stamp);
    }
  }

  Status take_state(const Message& answer, TimePoint stamp) {
    const Result<State> next = parse_state(answer);
    if (!next) return next.error();
    if (senses_->has_restarted(*next))
      return fail(Code::unavailable,
                  "its clock has gone back; was the robot's computer switched off and on?");
    heard(stamp);
    senses_->take(*next, stamp);
    if ((next->status & kMotionError) != 0)
      return fail(Code::unavailable,
                  "its axes report a motion error; is a wheel blocked, or a motor too hot? If the error "
                  "stays, switch the robot off and on");
    brake_what_moves();
    if (!is_active()) return ok();
    guard();
    senses_->publish_state();
    return ok();
  }

  // Axes that move when the robot was found, or is itself again, are braked once: nobody has told them to move. Later they may
  // move because somebody pushes the robot, which is limp then.
  void brake_what_moves() {
    if (!wants_stop_ || !is_ready()) return;
    wants_stop_ = false;
    brakes_ = senses_->moves();
  }

  // Stops the base where somebody else has taken it over. It moves on only for an operator.
  void guard() {
    if ((senses_->status() & kEmergencyStop) != 0) hold("its emergency stop is pressed; release it");
    if ((senses_->status() & kJoystick) != 0) hold("somebody drives it with the joystick; let go of that");
  }

  // It is told to stop at once, and again when its axes are ready: those that are not refuse.
  void hold(const std::string& reason) {
    const bool was_powered = powered_;
    rest();
    brakes_ = was_powered;
    wants_stop_ = true;
    await_person(reason);
  }

  // Axes that are not ready refuse; the next state says why.
  Status take_told(const Message& answer) {
    const Result<Returned> returned = returned_of(answer);
    if (!returned) return returned.error();
    if (*returned == Returned::ok) {
      refusals_ = 0;
      if (said_ == wish_) is_told_ = true;
      return ok();
    }
    say_at_ = host().now() + kAfterRefusal;
    if (++refusals_ < kRefusals) return ok();
    return fail(Code::unavailable, "N_SetAxes has returned " + text_of(*returned) +
                                       " again and again; is the robot zeroed, and are its axes ready?");
  }

  // Without its motion timer it would drive on when we are gone.
  Status take_timer(const Message& answer) {
    const Result<Returned> returned = returned_of(answer);
    if (!returned) return returned.error();
    if (answer.type == Type::set_timer) has_timer_ = *returned == Returned::ok;
    if (*returned == Returned::ok) return ok();
    return fail(Code::unavailable, "its motion timer does not work: the robot's library has returned " +
                                       text_of(*returned) + "; the base is not driven without it");
  }

  // A sensor that fails gives no readings, and says so once.
  Status take_readings(const Message& answer, TimePoint stamp) {
    const Status taken = senses_->take(answer, stamp, wish_.velocity, is_active());
    if (is_active()) motion()->press(senses_->pressed());
    const std::string complaint = taken.ok() ? "" : taken.error().text();
    if (!taken.ok() && complaint != complaint_) {
      complaint_ = complaint;
      warn("a sensor gives nothing: " + complaint);
    }
    return ok();
  }

  // Sends all that is due, if the agent has answered all that was sent before. It answers in the order of the requests.
  Status go_on() {
    if (session_->is_free())
      for (const Frame& request : due(host().now()))
        if (Status asked = session_->ask(request, host().now()); !asked.ok()) return asked;
    return line().flush();
  }

  std::vector<Frame> due(TimePoint now) {
    std::vector<Frame> requests;
    if (!has_timer_) requests.push_back(set_timer(kLimpAfter));
    if (powered_ && now >= feed_at_) {
      feed_at_ = now + kFeedPeriod;
      requests.push_back(ask(Type::reset_motion_timer));
    }
    if (must_say() && now >= say_at_) requests.push_back(say(now));
    if (std::exchange(brakes_, false) && !powered_) requests.push_back(drive_axes({.at_once = true}));
    for (Question& question : questions_) {
      if (now < question.next) continue;
      question.next = now + question.period;
      requests.push_back(ask(question.type));
    }
    return requests;
  }

  // Whether the axes are, or may be, doing something else than they are to do.
  [[nodiscard]] bool must_say() const {
    return powered_ && (!is_told_ || !wish_.stands() || senses_->moves());
  }

  Frame say(TimePoint now) {
    said_ = wish_;
    say_at_ = now + kSayAgain;
    return drive_axes(wish_);
  }

  // An emergency brakes with all that the axes can, and so harder than the library's stop mode.
  [[nodiscard]] Frame drive_axes(const DriveSetpoint& setpoint) const {
    return xr4000::drive(
        speeds_of(figures().calibration().to_controller(setpoint.velocity)),
        setpoint.at_once ? kHardest
                         : accelerations_of(figures().within(*max_acceleration_), *max_turn_acceleration_));
  }

  [[nodiscard]] bool is_ready() const {
    return (senses_->status() & (kEmergencyStop | kJoystick | kMotionError)) == 0;
  }

  Param<double> max_acceleration_{*this,
                                  "max_acceleration",
                                  0.5,
                                  {.unit = "m/s2",
                                   .min = 0.05,
                                   .max = 0.001 * kMaxAcceleration,
                                   .text = "Greatest acceleration along an axis."}};
  Param<double> max_turn_acceleration_{*this,
                                       "max_turn_acceleration",
                                       2.0,
                                       {.unit = "rad/s2",
                                        .min = 0.1,
                                        .max = 0.001 * kMaxTurnAcceleration,
                                        .text = "Greatest acceleration of the turn."}};
  Param<double> radius_{*this,
                        "radius",
                        kBodyRadius,
                        {.unit = "m",
                         .min = kRadius,
                         .max = 0.5,
                         .text = "Radius of the robot with its bumpers; measure it. As long as it is "
                                 "this one, that of the robot's file counts."}};
  Param<double> sonar_cycle_{
      *this,
      "sonar_cycle",
      0.2,
      {.unit = "s",
       .min = 0.05,
       .max = 2.0,
       .text = "Time in which all sonars fire once, as the agent has configured them. Above 0.25, SonarAvoid "
               "has forgotten an echo before the next one comes."}};
  Param<double> battery_scale_{
      *this,
      "battery_scale",
      0.0,
      {.unit = "V",
       .min = 0.0,
       .max = 10.0,
       .text = "Voltage of one count of the battery; measure it. 0: not known, and no battery is reported."}};
  Param<std::int64_t> battery_channel_{
      *this, "battery_channel", 0, {.min = 0, .max = 3, .text = "Channel of the battery that is reported."}};

  std::optional<XrSenses> senses_;
  std::optional<XrSession> session_;
  bool has_timer_ = false;  // it has accepted its time-out
  std::vector<Question> questions_;
  bool powered_ = false;     // it was told to move, and its motion timer is fed
  bool wants_stop_ = false;  // it is braked if it moves as soon as its axes are ready
  bool brakes_ = false;      // it is braked with the next requests
  DriveSetpoint wish_;       // what the axes are to do
  DriveSetpoint said_;       // what they were told last
  bool is_told_ = true;      // whether they have accepted the wish
  int refusals_ = 0;         // one after the other
  TimePoint say_at_{};
  TimePoint feed_at_{};
  std::string complaint_;  // about a sensor, that was made last
};

}  // namespace

ORCA_HARDWARE(Xr4000Base, "orca.hw.Xr4000")
