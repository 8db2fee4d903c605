// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "braking.hpp"
#include "crossing.hpp"
#include "machine.hpp"
#include "orca/component.hpp"
#include "orca/component/sender_life.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/geometry/arc.hpp"
#include "orca/geometry/objects/own_beams.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/moving.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/navigation/pose_history.hpp"
#include "sensor.hpp"
#include "surroundings.hpp"
#include "tally.hpp"

namespace {

using orca::ObjectPtr;
using orca::Pose2;
using orca::Status;
using orca::TimePoint;
using orca::Twist2;
using orca::gate::Sensor;
using orca::gate::Verdict;
using orca::idl::LaserRangeReadings;
using orca::idl::MotionCommand;
using orca::idl::SonarRangeReadings;

/// The last gate before the wheels: it passes commands on to a base, slower where the robot could not stop before what its sensors see,
/// and makes a stop of those that lead into it. It never makes a motion of a stop. See README.md.
class CollisionMonitor final : public orca::Component {
 public:
  explicit CollisionMonitor(orca::ComponentHost& host) : Component(host) {}

 private:
  static constexpr double kMissed = 3.0;           // periods without readings in which a sensor may be well
  static constexpr double kShortestSilence = 0.3;  // [s] A shorter one is no sign of a fault.
  static constexpr double kDeafAfter = 0.6;        // [s] The same of a sensor that announces no period.
  static constexpr double kRound = 0.5;            // [s] in which the slowest known ring of sonars fires once
  static constexpr double kShareOfCone = 0.5;      // An echo comes from the middle of a cone.
  static constexpr orca::Duration kIdleAfter = std::chrono::seconds(2);
  static constexpr orca::Duration kSureAfter = std::chrono::milliseconds(500);
  static constexpr orca::Duration kPassedAfter = std::chrono::milliseconds(100);
  static constexpr double kLong = 2.0;      // [s] of standing after which an alarm is raised
  static constexpr double kPatient = 10.0;  // [s] the same while somebody passes

  Status configure() override {
    if (robot_->empty())
      return robot_.refuse("it knows no body without the robot's file; give the one that the hardware has");
    auto machine = orca::gate::Machine::read(*robot_);
    if (!machine) return robot_.refuse(machine.error());
    machine_ = std::move(*machine);
    if (lasers_.sources().empty() && sonars_.sources().empty())
      return orca::fail(orca::Code::failed_precondition,
                        "it has nothing to see with; connect its port lasers or its port sonars");
    lap_on(odometry_);
    return orca::ok();
  }

  Status start() override {
    surroundings_.clear();
    history_.clear();
    laser_list_.clear();
    sonar_list_.clear();
    flank_list_.clear();
    twist_ = {};
    sent_ = {};
    tally_ = {};
    subscribe(lasers_, laser_list_);
    subscribe(sonars_, sonar_list_);
    subscribe(flank_sonars_, flank_list_);
    return orca::ok();
  }

  void stop() override {
    if (sent_ != Twist2{}) (void)base_.send(orca::full_stop());
    lasers_.unsubscribe_all();
    sonars_.unsubscribe_all();
    flank_sonars_.unsubscribe_all();
    blind_since_.reset();
    clear_alarm("SENSOR_SILENT", "the robot is not driven any more");
    clear_alarm("COLLISION_AHEAD", "the robot is not driven any more");
    tally_.has_acted() ? log_info(tally_.text()) : log_debug(tally_.text());
  }

  template <class Reading>
  static void subscribe(const orca::PushProxyArray<Reading>& port, std::vector<Sensor<Reading>>& sensors) {
    for (const auto& source : port.sources()) {
      if (std::ranges::find(sensors, source, &Sensor<Reading>::source) != sensors.end()) continue;
      source.subscribe();
      sensors.push_back({source});
    }
  }

  // Stops the robot even if nobody commands it: what comes into its way need not wait for the next command.
  orca::Outcome work() override {
    look_around();
    tally_.add(now(), twist_);
    const TimePoint last = commanded_at_.value_or(now());
    if (now() - last > kIdleAfter) stay_active(false);
    if (sent_ != Twist2{} && judge(sent_).at_once) stop_at_once();
    return orca::again();
  }

  Status on_command(const ObjectPtr<MotionCommand>& command) {
    if (Status sound = orca::hw::MotionHW::check(*command); !sound.ok()) return sound;
    if (Status sound = orca::check_command(command); !sound.ok()) return sound;
    const Twist2 wanted = machine_->twist_of(command);
    if (wanted.left != 0.0 && !machine_->slides())
      return orca::fail(orca::Code::failed_precondition, orca::hw::MotionHW::kNotSideways);
    if (wanted == Twist2{}) return send(orca::copy_value(command), wanted);
    commanded_at_ = now();
    stay_active(true);
    look_around();
    Verdict verdict = judge(wanted);
    if (!may_pass(verdict)) verdict.share = 0.0;
    note(verdict);
    if (verdict.share >= 1.0) return send(orca::copy_value(command), wanted);
    const Twist2 slower = verdict.share * wanted;
    if (slower == Twist2{}) return send(orca::full_stop(), {});
    if (slower.left != 0.0)
      return send(orca::slide(slower.forward, slower.left, slower.turn_rate, command->weight()), slower);
    return send(orca::turn(slower.turn_rate, slower.forward, command->weight()), slower);
  }

  // A robot that was stopped stands until it may drive on for a while: by the noise of a sensor it would come nearer scan by scan.
  bool may_pass(const Verdict& verdict) {
    if (verdict.share <= 0.0) {
      held_ = held_ || verdict.post || verdict.gives_way;
      gives_way_ = verdict.gives_way;
      free_since_.reset();
      return false;
    }
    if (!free_since_) free_since_ = now();
    if (held_ && now() - *free_since_ < (gives_way_ ? kPassedAfter : kSureAfter)) return false;
    held_ = false;
    return true;
  }

  Status send(orca::Loan<MotionCommand> command, const Twist2& twist) {
    orca::Status taken = base_.send(std::move(command));
    if (taken.ok()) sent_ = twist;
    return taken;
  }

  void stop_at_once() {
    held_ = true;
    if (const Status taken = send(orca::full_stop(), {}); !taken.ok())
      log_warning("the base refuses to stop: " + taken.error().text());
  }

  Verdict judge(const Twist2& wanted) {
    blind_ = why_blind();
    if (blind_.empty() && !looks_ahead()) blind_ = orca::gate::kNoneAhead;
    if (!blind_.empty()) return {0.0, true, std::nullopt};
    const auto state = gripper_.latest();
    const orca::collision::SweptBody& body = machine_->body(state && state->holds());
    const auto posts = surroundings_.posts(here(), touchable(wanted));
    const Verdict verdict =
        orca::gate::judge(body, posts, {wanted, twist_, held_}, machine_->rules(*reaction_time_, *margin_));
    if (verdict.post)
      in_the_way_ = orca::gate::text_of(posts[*verdict.post], body, surroundings_.source_of(*verdict.post));
    return among_people(verdict, body, wanted);
  }

  // Returns where the robot may touch what stands there: the contacts of a charger, if it creeps.
  [[nodiscard]] std::optional<orca::gate::Disc> touchable(const Twist2& wanted) const {
    const auto touch = touch_.latest();
    const double reach = machine_->body(false).reach();
    if (!touch || !orca::gate::creeps(wanted, reach) || !orca::gate::creeps(twist_, reach) ||
        orca::to_seconds(now() - orca::to_time_point(touch->creation_time())) > kShortestSilence)
      return std::nullopt;
    return orca::gate::Disc{{touch->coordinate().point().x(), touch->coordinate().point().y()},
                            touch->reach_radius().distance()};
  }

  // Lets people who move pass.
  Verdict among_people(Verdict verdict, const orca::collision::SweptBody& body, const Twist2& wanted) {
    const std::vector<orca::gate::Passer> people = passers();
    const orca::gate::Crossing crossing =
        orca::gate::cross(body, people, {wanted, twist_, held_}, machine_->rules(*reaction_time_, *margin_));
    if (crossing.share >= verdict.share && !crossing.at_once) return verdict;
    if (crossing.who) in_the_way_ = orca::gate::text_of(people[*crossing.who]);
    return {crossing.share, verdict.at_once || crossing.at_once, verdict.post, true};
  }

  [[nodiscard]] double age(TimePoint stamp) const { return orca::to_seconds(now() - stamp); }
  [[nodiscard]] double age_of(const orca::idl::MovingThings& moving) const {
    return age(orca::to_time_point(moving.stamp()));
  }

  // Returns who moves, in the frame of the robot.
  [[nodiscard]] std::vector<orca::gate::Passer> passers() const {
    const auto moving = moving_.latest();
    if (!moving) return {};
    auto people = surroundings_.comers(orca::to_seconds(now().time_since_epoch()), here());
    orca::gate::add_passers(*moving, age_of(*moving), here(), people);
    return people;
  }

  void note(const Verdict& verdict) {
    if (blind_.empty()) {
      blind_since_.reset();
      clear_alarm("SENSOR_SILENT", "all sensors are heard again");
    } else {
      if (!blind_since_) blind_since_ = now();
      if (orca::to_seconds(now() - *blind_since_) > kDeafAfter)
        raise_alarm("SENSOR_SILENT", orca::idl::ALARM_CRITICAL, "the robot stands: " + blind_);
      return;
    }
    const bool is_new = tally_.note(now(), verdict.share);
    if (verdict.share > 0.0) {
      clear_alarm("COLLISION_AHEAD", "the robot drives on");
      return;
    }
    if (is_new) log_info("stops the robot: " + in_the_way_);
    if (tally_.stands_for(now()) > (verdict.gives_way ? kPatient : kLong))
      raise_alarm("COLLISION_AHEAD", orca::idl::ALARM_WARNING,
                  "the robot stands: " + in_the_way_ + "; find another way, or clear this one");
  }

  // Takes all that the sensors have sent since the last time.
  void look_around() {
    while (odometry_.new_data_arrived()) follow(*odometry_.get_update());
    subscribe(lasers_, laser_list_);
    subscribe(sonars_, sonar_list_);
    subscribe(flank_sonars_, flank_list_);
    if (history_.empty()) return;
    for (Sensor<LaserRangeReadings>& laser : laser_list_)
      if (laser.source.new_data_arrived()) see(laser, laser.source.take_latest());
    for (Sensor<SonarRangeReadings>& ring : sonar_list_)
      if (ring.source.new_data_arrived()) hear(ring, ring.source.take_latest());
    for (Sensor<SonarRangeReadings>& ring : flank_list_)
      if (ring.source.new_data_arrived()) hear_flanks(ring, *ring.source.take_latest());
    surroundings_.forget(passers(), here());
  }

  void follow(const orca::idl::Odometry& odometry) {
    const TimePoint stamp = orca::to_time_point(odometry.stamp());
    moves_ =
        senders_.accepts(odometry) && senders_.accepts(odometry, orca::check_age(age(stamp), kDeafAfter));
    if (!moves_) return;
    if (odometer_.begins_anew(odometry)) {  // what it has seen lies elsewhere now
      surroundings_.clear();
      history_.clear();
    }
    const bool stands = orca::speed_of(twist_) < 0.005 && std::abs(twist_.turn_rate) < 0.01;
    if (!history_.empty()) surroundings_.age(orca::to_seconds(stamp - history_.newest()), !stands);
    twist_ = {odometry.translational_velocity(), odometry.sideways_velocity(), odometry.steering_velocity()};
    history_.add(stamp, orca::plane_pose(odometry));
    pose_ = orca::plane_pose(odometry);
    moved_at_ = now();
  }

  // Returns where the robot was or will be at an instant.
  [[nodiscard]] Pose2 at(TimePoint stamp) const {
    if (const auto known = history_.at(stamp)) return *known;
    return pose_ * orca::moved(twist_, orca::to_seconds(stamp - history_.newest()));
  }

  [[nodiscard]] Pose2 here() const { return at(now()); }

  void see(Sensor<LaserRangeReadings>& laser, const ObjectPtr<LaserRangeReadings>& scan) {
    const TimePoint stamp = orca::to_time_point(scan->stamp());
    const bool sound = senders_.accepts(*scan) && senders_.accepts(*scan, orca::check_view_ahead(*scan)) &&
                       senders_.accepts(*scan, orca::check_age(age(stamp), limit_of(laser)));
    laser.heard = sound ? std::optional(now()) : std::nullopt;
    laser.waiting = scan;
    if (!sound) return;
    laser.ahead = orca::check_looks_ahead(*scan).ok();
    surroundings_.see(laser.source.path(), {.ranges = {scan->ranges().begin(), scan->ranges().end()},
                                            .max_range = scan->max_range(),
                                            .angle_start = scan->angle_start(),
                                            .angle_increment = scan->angle_increment(),
                                            .X_OS = at(stamp) * orca::plane_pose(scan->pose()),
                                            .height = scan->pose().position().z()});
  }

  // A base reports its whole ring more often than the ring makes its round.
  void hear(Sensor<SonarRangeReadings>& ring, const ObjectPtr<SonarRangeReadings>& round) {
    ring.heard = senders_.accepts(*round) ? std::optional(now()) : std::nullopt;
    if (!ring.heard) return;
    ring.ahead = orca::check_looks_ahead(*round).ok();
    ring.fired.resize(std::min(round->ranges().size(), round->poses().size()));
    for (std::size_t i = 0; i < ring.fired.size(); ++i) {
      const bool has_stamp = i < round->stamps().size();
      const TimePoint fired = has_stamp ? orca::to_time_point(round->stamps()[i]) : now();
      if (fired == ring.fired[i]) continue;
      ring.fired[i] = fired;
      const Pose2 mount = orca::plane_pose(round->poses()[i]);
      surroundings_.hear(ring.source.path(),
                         {.sonar = i,
                          .range = round->ranges()[i] > round->min_range() ? round->ranges()[i] : 0.0,
                          .farthest = round->max_range(),
                          .half_angle = kShareOfCone * round->half_lobe(),
                          .X_OS = at(fired) * mount,
                          .place = mount.position()});
    }
  }

  // Hears who comes from where no laser looks.
  void hear_flanks(Sensor<SonarRangeReadings>& ring, const SonarRangeReadings& round) {
    if (!senders_.accepts(round)) return;
    const std::size_t count = std::min({round.ranges().size(), round.poses().size(), round.stamps().size()});
    ring.fired.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const TimePoint fired = orca::to_time_point(round.stamps()[i]);
      if (fired == std::exchange(ring.fired[i], fired)) continue;
      const Pose2 X_OS = at(fired) * orca::plane_pose(round.poses()[i]);
      surroundings_.hear_flank(
          ring.source.path(),
          {i, orca::to_seconds(fired.time_since_epoch()), round.ranges()[i], round.max_range(), X_OS},
          round.half_lobe());
    }
  }

  template <class Reading>
  [[nodiscard]] double limit_of(const Sensor<Reading>& sensor) const {
    const double period = orca::to_seconds(sensor.source.base_period());
    return period > 0.0 ? std::max(kShortestSilence, kMissed * period) : kDeafAfter;
  }

  template <class Reading>
  [[nodiscard]] bool is_silent(const Sensor<Reading>& sensor) const {
    return !sensor.heard || orca::to_seconds(now() - *sensor.heard) > limit_of(sensor);
  }

  [[nodiscard]] bool looks_ahead() const {
    const auto ahead = [](const auto& sensor) { return sensor.ahead; };
    return std::ranges::any_of(laser_list_, ahead) || std::ranges::any_of(sonar_list_, ahead);
  }

  // Returns why it must not let the robot drive, whatever the surroundings; empty if it may.
  [[nodiscard]] std::string why_blind() const {
    if (!moves_ || !moved_at_ || orca::to_seconds(now() - *moved_at_) > kDeafAfter)
      return "nothing valid comes at its port \"odometry\"";
    const auto moving = moving_.latest();
    if (moving_.connected() &&
        (!moving || !orca::check_reading(*moving).ok() || !orca::check_age(age_of(*moving), kDeafAfter).ok()))
      return "nothing valid comes at its port \"moving\"";
    for (const Sensor<LaserRangeReadings>& laser : laser_list_) {
      if (is_silent(laser)) return "nothing valid comes from " + laser.source.path();
      if (orca::is_covered(*laser.waiting)) return "something is at the laser of " + laser.source.path();
    }
    for (const Sensor<SonarRangeReadings>& ring : sonar_list_) {
      if (is_silent(ring)) return "nothing valid comes from " + ring.source.path();
      const auto last = std::ranges::max_element(ring.fired);
      if (last == ring.fired.end() || orca::to_seconds(now() - *last) > limit_of(ring) + kRound)
        return "no sonar of " + ring.source.path() + " fires; are the sonars off?";
    }
    return {};
  }

  orca::SendServer<MotionCommand> command_{
      *this,
      "MotionCommandSend",
      &CollisionMonitor::on_command,
      {.text = "Commands for the base: of a MotionCommandFuser, as a base takes them."}};
  orca::SendProxy<MotionCommand> base_{*this, "base", {.text = "The base that gets what may pass."}};
  orca::PushProxy<orca::idl::Odometry> odometry_{
      *this, "odometry", {.text = "Motion of the robot.", .depth = 16}};
  orca::PushProxyArray<LaserRangeReadings> lasers_{
      *this,
      "lasers",
      {.text = "Scans of its lasers. The robot stands while one is silent.", .optional = true}};
  orca::PushProxyArray<SonarRangeReadings> sonars_{
      *this,
      "sonars",
      {.text = "Readings of its sonars. The robot stands while a ring is silent.", .optional = true}};
  orca::PushProxyArray<SonarRangeReadings> flank_sonars_{
      *this,
      "flanks",
      {.text = "Sonars that hear who comes from where no laser looks; they count beside \"moving\".",
       .optional = true}};
  orca::PushProxy<orca::idl::GripperState> gripper_{
      *this,
      "gripper",
      {.text = "State of its gripper; with it what the gripper holds is a part of the body.",
       .optional = true}};

  orca::PushProxy<orca::idl::GoalPoint> touch_{
      *this, "touch", {.text = "What the robot is to touch, in its own frame: a Dock.", .optional = true}};
  orca::PushProxy<orca::idl::MovingThings> moving_{
      *this,
      "moving",
      {.text = "Who moves near the robot: a PersonTracker. With it the robot lets people pass.",
       .optional = true}};

  orca::Param<std::string> robot_{
      *this,
      "robot",
      "",
      {.file = true,
       .fixed = true,
       .text = "The robot's file: its body in space, its gripper, how it brakes."}};
  orca::Param<double> margin_{
      *this,
      "margin",
      0.03,
      {.unit = "m",
       .min = 0.001,
       .max = 0.3,
       .text = "Distance to keep at 0.2 m/s and more; below that in proportion, at least a third."}};
  orca::Param<double> reaction_time_{*this,
                                     "reaction_time",
                                     0.15,
                                     {.unit = "s",
                                      .min = 0.0,
                                      .max = 2.0,
                                      .text = "Time from an echo until the base has the command that answers "
                                              "it; the base's own delay is added."}};

  std::optional<orca::gate::Machine> machine_;
  orca::gate::Surroundings surroundings_;
  orca::gate::Tally tally_;
  orca::nav::PoseHistory history_;  // In the frame of the odometry, as all that it has seen.
  orca::SenderWatch senders_{host()};
  orca::SenderLife odometer_;
  std::vector<Sensor<LaserRangeReadings>> laser_list_;
  std::vector<Sensor<SonarRangeReadings>> sonar_list_;
  std::vector<Sensor<SonarRangeReadings>> flank_list_;
  Pose2 pose_;
  Twist2 twist_;
  Twist2 sent_;             // the last command of the base
  bool gives_way_ = false;  // whether that was for people
  bool held_ = false;       // whether it has made a stop of a command, and nothing has passed since
  std::optional<TimePoint> free_since_;  // the first command that may pass since one that might not
  bool moves_ = false;
  std::optional<TimePoint> moved_at_;
  std::optional<TimePoint> commanded_at_;
  std::optional<TimePoint> blind_since_;
  std::string blind_;       // why it sees nothing; empty: it sees
  std::string in_the_way_;  // for people
};

}  // namespace

ORCA_COMPONENT(CollisionMonitor, "orca.CollisionMonitor")
