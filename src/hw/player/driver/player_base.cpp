// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/hardware.hpp"
#include "orca/hw/base_driver.hpp"
#include "orca/hw/player/payload.hpp"
#include "player_senses.hpp"
#include "player_session.hpp"
#include "player_uses.hpp"
#include "ranger_view.hpp"

namespace {

using namespace orca;
using namespace orca::hw;
using namespace orca::hw::player;

constexpr Duration kSayAgain = 250ms;  // what it is to do; most drivers have no watchdog
constexpr Duration kPowerAnswer = 1s;  // for the answer to the request for power
constexpr double kSamePlace = 0.01;    // [m] and [rad]

/// A robot behind a Player server: its base (position2d), and its sonars, laser, bumpers and battery as far as the server has them.
///
/// Data come by themselves, as they arise. The motors get power with the first command to move, not before, and lose it when nobody uses the
/// base. After a fault they stay off until an operator lets the base move again. What must be known before the connection, the shape of
/// the robot and of its laser, are parameters; if the server says something else, that is told.
class PlayerBase final : public BaseDriver {
 public:
  explicit PlayerBase(HardwareHost& host)
      : BaseDriver(host, "tcp:localhost:6665", {},
                   {.name = "Player",
                    .usual = {.max_speed = 0.5,
                              .max_turn_rate = 1.5,
                              .steer_gain = 1.0,
                              .big_turn_angle = std::numbers::pi / 3.0,
                              .big_turn_speed = 0.3}}) {}

 protected:
  void check(std::vector<HardwareFault>& faults) override { uses_ = read_uses(*uses_text_, faults); }

  std::vector<SensorEndpoint*> make_senses() override {
    senses_.emplace(uses_, PlayerRobotShape{.radius = *radius_, .sonar_range = *sonar_range_});
    return senses_->endpoints();
  }

  void describe(idl::Robot& robot) const override {
    robot.vendor("Player");
    robot.model("position2d");
    robot.radius(*radius_);
    robot.bumper_radius(*radius_);
    robot.length(*length_);
    robot.width(*width_);
    if (used_as(Part::laser)) robot.laser_sensors().push_back(describe_laser());
  }

  LineSession& session() override {
    if (!session_) session_.emplace(line(), uses_, from_seconds(*patience_));
    return *session_;
  }

  // What an earlier client has told the base may still go on.
  Status meet() override {
    const PlayerRobotFacts& facts = session_->facts();
    log_connected("a Player server " + in_quotes(printable(facts.version)) + " with a base of its driver " +
                  in_quotes(facts.driver));
    for (const std::string& shortcoming : facts.shortcomings) warn(shortcoming);
    compare_shape(facts);
    is_scan_compared_ = false;
    senses_->connect(facts);
    powered_ = false;
    return say({});
  }

  [[nodiscard]] TimePoint next_turn() const override { return say_again_; }
  void stop() override {
    (void)say({});
    (void)switch_motors(false);
  }

  void take_leave() override {
    if (!session_) return;
    stop();
    applied_ = {};
  }

  Status poll() override {
    const TimePoint now = host().now();
    const auto taken = [this](const Message& message, TimePoint sent) { take(message, sent); };
    if (Status read = session_->receive(now, taken); !read.ok()) return read;
    miss_power(now);
    if (now < say_again_) return line().flush();
    return powered_ ? say(applied_) : rest();
  }

  Status drive(const DriveSetpoint& setpoint) override {
    applied_ = setpoint;
    if (!setpoint.stands() && !powered_)
      if (Status on = switch_motors(true); !on.ok()) return on;
    return say(setpoint);
  }

 private:
  // Returns null if it is not used.
  [[nodiscard]] const Use* used_as(Part part) const {
    const auto use = std::ranges::find(uses_, part, &Use::part);
    return use != uses_.end() ? &*use : nullptr;
  }

  [[nodiscard]] idl::LaserSensor describe_laser() const {
    const double step = *laser_beams_ > 1 ? *laser_angle_ / static_cast<double>(*laser_beams_ - 1) : 0.0;
    idl::LaserSensor laser;
    laser.name("laser");
    laser.vendor("Player");
    laser.model(used_as(Part::laser)->interface == Interface::ranger ? "ranger" : "laser");
    laser.port(device());
    laser.type("LaserRangeReadings");
    laser.update_interval(0.1);
    laser.mount(level_frame({*laser_x_, *laser_y_, 0.0}, *laser_z_));
    laser.number(static_cast<std::uint32_t>(*laser_beams_));
    laser.angle_start(-0.5 * *laser_angle_);
    laser.angle_increment(step);
    laser.min_range(0.0);
    laser.max_range(*laser_range_);
    return laser;
  }

  void compare_shape(const PlayerRobotFacts& facts) {
    if (facts.base) {
      compare("length", *length_, facts.base->size.length);
      compare("width", *width_, facts.base->size.width);
    }
    if (!facts.laser) return;
    compare("laser_x", *laser_x_, facts.laser->pose.x);
    compare("laser_y", *laser_y_, facts.laser->pose.y);
    compare("laser_z", *laser_z_, facts.laser->pose.z);
  }

  // A server that says 0 for a length does not know it.
  void compare(const std::string& param, double here, double there) {
    const bool is_known = std::isfinite(there) && (there > 0.0 || param.starts_with("laser"));
    if (is_known && std::abs(there - here) > kSamePlace)
      warn("the server says " + shown(there) + " and this graph " + shown(here) + "; write " + param + "=\"" +
           shown(there) + "\" if the server is right");
  }

  void compare_scan(const LaserScan& scan) {
    if (std::exchange(is_scan_compared_, true)) return;
    compare("laser_beams", static_cast<double>(*laser_beams_), static_cast<double>(scan.ranges.size()));
    compare("laser_angle", *laser_angle_, static_cast<double>(scan.max_angle) - scan.min_angle);
  }

  static std::string shown(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", number);
    return text;
  }

  void take(const Message& message, TimePoint now) {
    const Address& from = message.header.address;
    const auto use = std::ranges::find_if(
        uses_, [&](const Use& used) { return used.interface == from.interface && used.index == from.index; });
    if (use == uses_.end()) return;
    if (session_->take_late(message)) return learn(*use);
    const MessageId id = id_of(message.header);
    if (id == kPosition2dState) {
      take_state(message, now);
    } else if (id == kSonarRanges) {
      pass_on(decode<SonarRanges>(message.payload), now);
    } else if (id == kLaserScan) {
      pass_on(decode<LaserScan>(message.payload), now);
    } else if (id == kBumperState) {
      take_bumpers(message, now);
    } else if (id == kPowerState) {
      pass_on(decode<PowerState>(message.payload), now);
    } else if (use->part == Part::base) {
      take_answer(id);
    } else if (const auto ranges = read_ranges(message)) {
      take_ranges(*use, *ranges, now);
    }
  }

  // A driver has started, and says where its device is.
  void learn(const Use& use) {
    host().write_log(log::Level::info, "the server says now where " + device_name(use) + " is");
    compare_shape(session_->facts());
    senses_->learn(session_->facts());
  }

  void take_answer(const MessageId& id) {
    const bool is_refused = id.type == MessageType::nack;
    if (id.subtype != kPosition2dMotorPower.subtype || (!is_refused && id.type != MessageType::ack)) return;
    power_due_ = kForever;
    if (is_refused && powered_)
      warn("the server refuses power for the motors; is an emergency button pressed?");
  }

  void take_ranges(const Use& use, const Result<RangerStamped>& ranger, TimePoint now) {
    if (!ranger) return session_->note_bad();
    if (use.part == Part::sonar) return pass_on(Result<SonarRanges>(as_sonar(ranger->ranges)), now);
    const RangerConfig otherwise{
        .min_angle = -0.5 * *laser_angle_, .max_angle = 0.5 * *laser_angle_, .max_range = *laser_range_};
    const auto& config = ranger->config ? ranger->config : session_->facts().angles;
    pass_on(Result<LaserScan>(as_laser(ranger->ranges, config, otherwise)), now);
  }

  void take_state(const Message& message, TimePoint now) {
    const Result<Position2dState> state = decode<Position2dState>(message.payload);
    if (!state || !senses_->take(*state, now, is_active())) return session_->note_bad();
    heard(now);
    if (state->stall && is_active()) motion()->obstruct("its motors are stalled", Hindrance::stall);
  }

  void take_bumpers(const Message& message, TimePoint now) {
    const Result<BumperState> bumpers = decode<BumperState>(message.payload);
    if (!bumpers || !senses_->take(*bumpers, applied_.velocity.forward, now, is_active()))
      return session_->note_bad();
    if (is_active()) motion()->press(senses_->pressed());
  }

  template <class Data>
  void pass_on(const Result<Data>& data, TimePoint now) {
    if (!data || !senses_->take(*data, now, is_active())) return session_->note_bad();
    if constexpr (std::is_same_v<Data, LaserScan>) compare_scan(*data);
    if (const std::string remark = senses_->take_remark(); !remark.empty()) warn(remark);
  }

  // A driver that does not know the request drops it, and its motors may have power all the time.
  void miss_power(TimePoint now) {
    if (now < power_due_) return;
    power_due_ = kForever;
    warn(
        "the server has not answered the request for motor power within 1 s; if the base does not move, see "
        "what the server has printed");
  }

  Status rest() {
    say_again_ = host().now() + kSayAgain;
    return line().flush();
  }

  Status say(const DriveSetpoint& setpoint) {
    say_again_ = host().now() + kSayAgain;
    const Twist2& velocity = setpoint.velocity;
    return session_->send(
        kPosition2dVelocity,
        encode(VelocityCommand{.velocity = {velocity.forward, 0.0, velocity.turn_rate}, .motors_on = true}),
        uses_.front().index);
  }

  Status switch_motors(bool on) {
    powered_ = on;
    power_due_ = on ? host().now() + kPowerAnswer : kForever;
    return session_->send(kPosition2dMotorPower, encode(Switch{on}), uses_.front().index);
  }

  Param<std::string> uses_text_{
      *this,
      "uses",
      "sonar laser bumper power",
      {.text =
           "What of the robot is used beside its base, with blanks between. Each is the device 0 of the "
           "interface of its name, or another one: sonar=ranger:0 laser=ranger:1, as the simulator Stage has "
           "them, laser=laser:1, base=position2d:1."}};
  Param<double> patience_{
      *this,
      "patience",
      8.0,
      {.unit = "s",
       .min = 0.1,
       .max = 600.0,
       .text = "Longest time in which a device opens, and in which its driver says where it is; a laser may "
               "need half a minute. The deployer gives up after 10 s."}};
  Param<double> radius_{
      *this, "radius", 0.3, {.unit = "m", .min = 0.0, .text = "Of the circle that holds the body."}};
  Param<double> length_{
      *this, "length", 0.44, {.unit = "m", .min = 0.0, .text = "Of the body; 0: it is round."}};
  Param<double> width_{
      *this, "width", 0.38, {.unit = "m", .min = 0.0, .text = "Of the body; 0: it is round."}};
  Param<double> sonar_range_{
      *this, "sonar_range", 5.0, {.unit = "m", .min = 0.1, .text = "Longest range of the sonars."}};
  Param<std::int64_t> laser_beams_{
      *this, "laser_beams", 181, {.min = 1, .max = 100'000, .text = "Number of beams of the laser."}};
  Param<double> laser_angle_{
      *this,
      "laser_angle",
      3.141592653589793,
      {.unit = "rad", .min = 0.0, .text = "From its first beam to the last; ahead is in the middle."}};
  Param<double> laser_range_{
      *this, "laser_range", 8.0, {.unit = "m", .min = 0.1, .text = "Longest range of the laser."}};
  Param<double> laser_x_{
      *this, "laser_x", 0.0, {.unit = "m", .text = "Where the laser sits: ahead of the middle."}};
  Param<double> laser_y_{*this, "laser_y", 0.0, {.unit = "m", .text = "To the left of the middle."}};
  Param<double> laser_z_{
      *this, "laser_z", 0.0, {.unit = "m", .text = "Height of its beams above the floor."}};

  std::vector<Use> uses_;  // the base first
  std::optional<PlayerSenses> senses_;
  std::optional<PlayerSession> session_;
  bool powered_ = false;            // the motors
  bool is_scan_compared_ = false;   // with what the parameters say
  DriveSetpoint applied_;           // what the wheels were told last
  TimePoint power_due_ = kForever;  // the answer to the request for power
  TimePoint say_again_{};
};

}  // namespace

ORCA_HARDWARE(PlayerBase, "orca.hw.Player")
