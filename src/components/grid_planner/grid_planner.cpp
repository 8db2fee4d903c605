// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "orca/base/portable_math.hpp"
#include "orca/component/held_motors.hpp"
#include "orca/component/standing_watch.hpp"
#include "orca/geometry/objects/own_beams.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/geometry/objects/waiting_scans.hpp"
#include "orca/goals/goal_follower.hpp"
#include "orca/idl/time.hpp"
#include "orca/navigation/beams.hpp"
#include "orca/navigation/navigator.hpp"
#include "orca/navigation/pose_history.hpp"
#include "orca/planning/asked_robot.hpp"
#include "orca/planning/recoveries.hpp"
#include "outlook.hpp"

namespace {

using orca::ObjectPtr;
using orca::Pose2;
using orca::Status;
using orca::Vec2;
using orca::go::Step;
using orca::go::Target;
using orca::planning::Body;

double at_most(double wish, double most) { return most > 0.0 ? std::min(wish, most) : wish; }

/// A behaviour that drives to goals by a plan: it maps what its laser sees, finds the cheapest way through the map and follows it.
/// It takes the place of Goto and an avoid behaviour. See README.md.
class GridPlanner final : public orca::go::GoalFollower {
 public:
  explicit GridPlanner(orca::ComponentHost& host) : GoalFollower(host, kBlockedAfter) {}

 private:
  static constexpr const char* kType = "orca.GridPlanner";
  static constexpr double kBlockedAfter = 60.0;  // [s]
  static constexpr double kBrakes = 0.8;         // of the change of speed that the base is capable of
  static constexpr double kSlow = 0.01;          // [m/s], [rad/s]
  static constexpr double kOwnEcho = 0.1;        // [m] what scanners see so near to the robot is the robot
  using Scanners = orca::PushProxyArray<orca::idl::LaserRangeReadings>;

  Status configure() override {
    const Status sound = GoalFollower::configure();
    if (!localizer().connected() && !scanners_.sources().empty())
      return orca::fail(orca::Code::failed_precondition,
                        "with scanners, connect its port localizer too: they see places of the world");
    if (odometry().connected()) lap_on("odometry");
    return sound.ok() ? recoveries_.check() : sound;
  }

  Status start() override {
    if (Status begun = GoalFollower::start(); !begun.ok()) return begun;
    history_.clear();
    X_MO_.reset();
    scans_.clear();
    heard_at_.reset();
    navigator_.reset();
    listened_.clear();
    return robot_.ask();
  }

  void stop() override {
    robot_.leave();
    recoveries_.note(std::nullopt);
    scanners_.unsubscribe_all();
    GoalFollower::stop();
  }

  Status params_changed() override {
    if (const Status sound = recoveries_.check(); !sound.ok()) return sound;
    if (navigator_) navigator_->set_rules(rules());
    return orca::ok();
  }

  // A successor that has this gives the commands that this object would have given.
  void save_state(orca::StateWriter& state) const override {
    GoalFollower::save_state(state);
    state.write(robot_.body(), history_, X_MO_, scans_, twist_, heard_at_, wants_fix_);
    state.write(navigator_.has_value());
    if (navigator_) state.write(navigator_->map().packed(), *navigator_);
  }

  Status load_state(orca::StateReader& state) override {
    if (Status read = GoalFollower::load_state(state); !read.ok()) return read;
    if (state.tag().type != kType) return orca::ok();
    auto [body] = robot_.state();
    bool has_navigator = false;
    Status read = state.read(body, history_, X_MO_, scans_, twist_, heard_at_, wants_fix_, has_navigator);
    if (!read.ok() || !has_navigator) return read;
    navigator_.emplace(footprint(), rules());
    std::string map;
    read = state.read(map);
    if (read.ok()) read = std::apply([&](auto&... part) { return state.read(part...); }, navigator_->state());
    const bool fits = read.ok() && navigator_->unpack_map(map);
    if (!fits) navigator_.emplace(footprint(), rules());  // also if the map has another size now
    return read;
  }

  [[nodiscard]] std::uint32_t state_version() const override { return 4; }
  [[nodiscard]] std::vector<orca::StateTag> accepted_states() const override { return {{"orca.Goto", 2}}; }

  orca::Outcome work() override {
    if (const Status learnt = robot_.learn(); !learnt.ok()) return orca::failed(learnt.error().text());
    if (!navigator_ && !robot_.is_asked()) navigator_.emplace(footprint(), rules());
    return GoalFollower::work();
  }

  // Between two poses of the localizer odometry carries the robot on.
  std::optional<Pose2> take_pose() override {
    while (laser_.new_data_arrived()) take_scan();
    if (!take_motion()) return std::nullopt;
    const Pose2 pose = in_map(history_.at(posed_at()).value_or(Pose2{}));
    if (navigator_) hear(pose), hear_scanners(pose);
    return pose;
  }

  // A scan that says nothing valid is none: the laser is silent until another one comes.
  void take_scan() {
    const ObjectPtr<orca::idl::LaserRangeReadings> scan = laser_.get_update();
    const double age =
        history_.empty() ? 0.0 : orca::to_seconds(history_.newest() - orca::to_time_point(scan->stamp()));
    if (is_valid(*scan) && is_valid(*scan, orca::check_looks_ahead(*scan)) &&
        is_valid(*scan, orca::check_view_ahead(*scan)) && is_valid(*scan, orca::check_age(age, *deaf_after_)))
      return scans_.add(scan);
    scans_.clear();
    heard_at_.reset();
  }

  // Returns whether it knows where the robot is and how it moves.
  bool take_motion() {
    if (odometry().connected() && localizer().connected()) return take_odometry_and_fix();
    const auto pose = GoalFollower::take_pose();
    if (!pose) return false;
    if (localizer().connected()) {
      note_motion(*localizer().latest(), posed_at(), *pose);
    } else {
      note_motion(*odometry().latest(), posed_at(), *pose);
    }
    return true;
  }

  bool take_odometry_and_fix() {
    ObjectPtr<orca::idl::Odometry> moved;
    do {  // several wait if a lap takes longer than it is to the next one
      moved = odometry().get_update();
      if (!is_valid(*moved)) return false;
      note_odometry(*moved);
      note_motion(*moved, orca::to_time_point(moved->stamp()), orca::plane_pose(*moved));
    } while (odometry().new_data_arrived());
    const bool is_new = localizer().new_data_arrived();
    if (wants_fix_ && !is_new) return false;
    auto fix = localizer().get_update();
    while (localizer().new_data_arrived()) fix = localizer().get_update();
    if (!is_valid(*fix) || (is_new && !is_valid(*fix, orca::go::check_present(now(), fix->stamp()))))
      return false;
    if (is_new || !X_MO_) take_fix(*fix);
    wants_fix_ = false;
    note_pose(moved->stamp(), fix->covariance());
    return true;
  }

  template <typename Motion>
  void note_motion(const Motion& motion, orca::TimePoint stamp, const Pose2& pose) {
    twist_ = {motion.translational_velocity(), motion.sideways_velocity(), motion.steering_velocity()};
    history_.add(stamp, pose);
  }

  // Finds where the frame of the odometry is: at the instant of the fix both poses are known.
  void take_fix(const orca::idl::RobotPose& fix) {
    const auto then = history_.at(orca::to_time_point(fix.stamp()));
    if (!then && X_MO_) return;
    X_MO_ = orca::plane_pose(fix) * inverse(then.value_or(history_.at(history_.newest()).value_or(Pose2{})));
  }

  [[nodiscard]] Pose2 in_map(const Pose2& X_OR) const { return X_MO_ ? *X_MO_ * X_OR : X_OR; }

  // The scan waits for the pose of its last beam.
  void hear(const Pose2& pose) {
    const orca::ScanPtr scan = scans_.take_until(history_.newest());
    if (!scan) return;
    const auto X_OR_first = history_.at(orca::to_time_point(scan->stamp()));
    const auto X_OR_last = history_.at(orca::last_beam_of(*scan));
    if (!X_OR_first || !X_OR_last) return;
    const Pose2 mount = orca::plane_pose(scan->pose());
    orca::nav::beams_of({scan->ranges(), scan->min_range(), scan->max_range(), scan->angle_start(),
                         scan->angle_increment(), in_map(*X_OR_first) * mount, in_map(*X_OR_last) * mount},
                        *map_range_, beams_);
    navigator_->hear(beams_, pose);
    outlook_.map.show(navigator_->map(), now());
    heard_at_ = now();
  }

  void hear_scanners(const Pose2& pose) {
    for (const Scanners::Source& scanner : scanners_.sources()) {
      if (std::ranges::find(listened_, scanner) == listened_.end()) {
        scanner.subscribe();
        listened_.push_back(scanner);
      }
      if (!scanner.new_data_arrived()) continue;
      if (const auto scan = scanner.take_latest(); is_valid(*scan)) hear(*scan, pose);
    }
  }

  // Puts what a scanner that stands somewhere sees into the map, but for the robot.
  void hear(const orca::idl::LaserRangeReadings& scan, const Pose2& pose) {
    const auto then = history_.at(orca::to_time_point(scan.stamp()));
    const Vec2 robot = then ? in_map(*then).position() : pose.position();
    const Pose2 mount = orca::plane_pose(scan.pose());
    orca::nav::beams_of({scan.ranges(), scan.min_range(), scan.max_range(), scan.angle_start(),
                         scan.angle_increment(), mount, mount},
                        scan.max_range(), beams_);
    const double near = footprint().outer_radius() + kOwnEcho;
    std::erase_if(beams_, [&](const orca::nav::Beam& beam) { return norm(beam.to - robot) < near; });
    navigator_->hear(beams_, pose);
  }

  // Forgets the map, whose content lies elsewhere now, and the place of the odometry's frame in it.
  void forget_places() override {
    navigator_.reset();
    history_.clear();
    X_MO_.reset();
    scans_.clear();
    heard_at_.reset();
    wants_fix_ = true;
  }

  void idle() override {
    standing_.reset();
    recoveries_.note(std::nullopt);
    if (navigator_) navigator_->drop_path();
  }

  void drive(const Pose2& pose, const Target& target) override {
    const bool held = orca::are_motors_held(kept_alarms());
    if (held) idle();  // there is nothing to recover from, neither now nor at the release
    const bool hears = navigator_ && heard_at_ && orca::to_seconds(now() - *heard_at_) <= *deaf_after_;
    const bool stands = std::abs(twist_.forward) < kSlow && std::abs(twist_.turn_rate) < kSlow;
    standing_.look(stands, [&] { return hears ? what_holds() : why_deaf(); });
    const auto scan = laser_.latest();
    if (held || !hears || (scan && orca::is_covered(*scan))) {
      motion().push(orca::full_stop());
      note_speed(0.0);
      return;
    }
    const orca::nav::Moment moment{now(), pose, twist_};
    if (auto step = step_of_rest(target, pose, deceleration(), before())) {
      outlook_.lead.name(target.place, target.reach_radius);
      return rest(*step, moment, target);
    }
    const orca::nav::Steer steer = navigator_->steer(moment, {place_for(pose, target), target.via});
    motion().push(orca::turn(steer.turn_rate, steer.speed, weight()));
    recoveries_.note(navigator_->recovery());
    note_speed(steer.speed);
    note_plan(navigator_->way_left());
    if (const auto ahead = navigator_->ahead(moment)) outlook_.lead.name(*ahead, 0.0);
  }

  [[nodiscard]] std::string what_holds() const override {
    const auto scan = laser_.latest();
    const orca::nav::Footprint own = footprint();
    const std::string beams =
        scan ? orca::beams_at_robot(*scan, {own.radius, 2.0 * own.half_length, 2.0 * own.half_width}) : "";
    return beams.empty() ? beams : "of the laser \"" + scan->origin() + "\" " + beams;
  }

  [[nodiscard]] std::string why_deaf() const {
    if (robot_.is_asked()) return "the base has not described the robot yet";
    const auto scan = laser_.latest();
    const bool comes = scan && orca::check_reading(*scan).ok() &&
                       orca::to_seconds(now() - orca::to_time_point(scan->creation_time())) <= *deaf_after_;
    return comes ? "scans of \"" + scan->origin() +
                       "\" come, but no pose of the time at which they were taken: stamps do not meet"
                 : "nothing valid comes at its port \"laser\"";
  }

  // Comes to rest within reach of a goal, but not by driving into something.
  void rest(Step step, const orca::nav::Moment& moment, const Target& target) {
    const double most =
        orca::nav::speed_to_stop_within(navigator_->room_ahead(moment), deceleration(), *reaction_time_);
    step.speed = std::min(step.speed, most);
    if (step.kind == Step::Kind::reached) navigator_->drop_path();
    take(step, moment.pose, target);
  }

  // Returns where to drive to: the target, or a place farther along on the circle around one that has no reach.
  [[nodiscard]] Vec2 place_for(const Pose2& pose, const Target& target) const {
    if (target.reach_radius > 0.0) return target.place;
    const Vec2 off = pose.position() - target.place;
    constexpr double kAhead = 0.9;  // [rad]
    const double angle = orca::portable::atan2(off.y, off.x) + kAhead;
    return target.place + *circle_radius_ * orca::direction(angle);
  }

  [[nodiscard]] orca::nav::Footprint footprint() const {
    if (robot_.body()) return robot_.body()->outline();
    const bool is_round = *robot_length_ <= 0.0 || *robot_width_ <= 0.0;
    return Body{is_round ? *robot_radius_ : 0.0, *robot_length_, *robot_width_}.outline();
  }

  [[nodiscard]] double deceleration() const {
    if (*deceleration_ > 0.0) return *deceleration_;
    constexpr double kCareful = 0.5;  // [m/s2]
    const auto& body = robot_.body();
    return body && body->acceleration > 0.0 ? kBrakes * body->acceleration : kCareful;
  }

  [[nodiscard]] orca::nav::NavigatorRules rules() const {
    const Body body = robot_.body().value_or(Body{});
    orca::nav::NavigatorRules rules;
    rules.pursuit.max_speed = at_most(*max_speed_, body.max_speed);
    rules.pursuit.turn_rate = at_most(*turn_rate_, body.max_rate);
    rules.pursuit.look_ahead_time = *look_ahead_time_;
    rules.pursuit.lateral_acceleration = *lateral_acceleration_;
    rules.pursuit.deceleration = deceleration();
    rules.pursuit.delay = *reaction_time_;
    rules.pursuit.narrow_speed = *narrow_speed_;
    rules.pursuit.speed_per_clearance = *speed_per_clearance_;
    rules.pursuit.margin = *margin_;
    rules.wishes.clearance = *clearance_;
    rules.extent = *map_size_;
    rules.replan_every = *replan_every_;
    rules.recoveries = recoveries_.order();
    return rules;
  }

  orca::PushProxy<orca::idl::LaserRangeReadings> laser_{*this, "laser", {.text = "Scans of the laser."}};
  Scanners scanners_{*this,
                     "scanners",
                     {.text = "Scans of lasers that stand somewhere and report their places in the world; "
                              "needs a localizer.",
                      .optional = true}};
  orca::planning::AskedRobot robot_{*this};
  orca::planner::Outlook outlook_{*this};
  orca::planning::Recoveries recoveries_{*this, host()};
  orca::Param<double> max_speed_{
      *this, "max_speed", 0.5, {.unit = "m/s", .min = 0.0, .text = "Largest speed."}};
  orca::Param<double> turn_rate_{
      *this, "turn_rate", 1.5, {.unit = "rad/s", .min = 0.05, .text = "Largest turn rate."}};
  orca::Param<double> deceleration_{
      *this,
      "deceleration",
      0.0,
      {.unit = "m/s2",
       .min = 0.0,
       .text = "Deceleration that it counts on; 0: four fifths of what the base says, or 0.5 m/s2."}};
  orca::Param<double> lateral_acceleration_{
      *this,
      "lateral_acceleration",
      1.0,
      {.unit = "m/s2", .min = 0.01, .text = "Largest acceleration in a bend."}};
  orca::Param<double> reaction_time_{
      *this,
      "reaction_time",
      0.15,
      {.unit = "s", .min = 0.0, .text = "Time from a measurement until the robot moves as it demands."}};
  orca::Param<double> look_ahead_time_{
      *this,
      "look_ahead_time",
      0.9,
      {.unit = "s",
       .min = 0.1,
       .text = "The point of the path to steer for is as far ahead as it drives in this time."}};
  orca::Param<double> margin_{
      *this, "margin", 0.03, {.unit = "m", .min = 0.0, .text = "Free space to keep around the outline."}};
  orca::Param<double> narrow_speed_{
      *this,
      "narrow_speed",
      0.4,
      {.unit = "m/s", .min = 0.01, .text = "Largest speed where nothing beyond the margin is free."}};
  orca::Param<double> speed_per_clearance_{
      *this,
      "speed_per_clearance",
      4.0,
      {.unit = "1/s", .min = 0.0, .text = "Speed that each free metre beyond the margin adds to that."}};
  orca::Param<double> clearance_{
      *this,
      "clearance",
      0.35,
      {.unit = "m",
       .min = 0.05,
       .text = "Free space beside the robot up to which more makes a way cheaper."}};
  orca::Param<double> replan_every_{
      *this,
      "replan_every",
      0.5,
      {.unit = "s", .min = 0.05, .text = "Time after which it looks for a better path."}};
  orca::Param<double> map_size_{
      *this,
      "map_size",
      16.0,
      {.unit = "m",
       .min = 4.0,
       .max = 60.0,
       .text = "Side of the square map around the robot, as it is when work begins."}};
  orca::Param<double> map_range_{
      *this,
      "map_range",
      6.0,
      {.unit = "m", .min = 0.5, .text = "Echoes farther away are not put into the map."}};
  orca::Param<double> deaf_after_{
      *this,
      "deaf_after",
      0.6,
      {.unit = "s", .min = 0.0, .text = "Time without scans after which the robot stops."}};
  orca::Param<double> circle_radius_{
      *this,
      "circle_radius",
      0.6,
      {.unit = "m", .min = 0.05, .text = "Radius of the circle around a goal whose reach_radius is 0."}};
  orca::Param<double> robot_radius_{
      *this,
      "robot_radius",
      0.3,
      {.unit = "m",
       .min = 0.01,
       .text = "Radius of the circle that holds the robot, unless the base says it."}};
  orca::Param<double> robot_length_{
      *this,
      "robot_length",
      0.0,
      {.unit = "m",
       .min = 0.0,
       .text = "Length of a rectangular robot, unless the base says it; 0: the circle is all."}};
  orca::Param<double> robot_width_{
      *this, "robot_width", 0.0, {.unit = "m", .min = 0.0, .text = "Its width."}};

  std::optional<orca::nav::Navigator> navigator_;  // from when the outline is known
  orca::nav::PoseHistory history_;                 // in the frame of the odometry; without one, of the goals
  std::optional<Pose2> X_MO_;  // the frame of the odometry in that of the goals; nothing: they are the same
  orca::WaitingScans scans_;
  std::vector<orca::nav::Beam> beams_;
  std::vector<Scanners::Source> listened_;
  orca::Twist2 twist_;
  std::optional<orca::TimePoint> heard_at_;
  orca::StandingWatch standing_{host()};
  bool wants_fix_ = false;  // a pose of the localizer from after the places were forgotten
};

}  // namespace

ORCA_COMPONENT(GridPlanner, "orca.GridPlanner")
