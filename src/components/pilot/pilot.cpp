// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "orca/component/held_motors.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/goals/goal_follower.hpp"
#include "orca/idl/time.hpp"
#include "orca/navigation/path_driver.hpp"
#include "orca/planning/asked_robot.hpp"
#include "orca/planning/floor.hpp"
#include "orca/planning/layer_file.hpp"
#include "orca/planning/recoveries.hpp"

namespace {

using orca::Pose2;
using orca::Status;
using orca::Vec2;
using orca::go::Step;
using orca::go::Target;
using orca::idl::OccupancyGrid;
using orca::nav::Moment;
using orca::nav::Steer;

double at_most(double wish, double most) { return most > 0.0 ? std::min(wish, most) : wish; }

/// A part of a path that is driven in one direction.
struct Stretch {
  orca::nav::Path path;
  bool backwards = false;

  [[nodiscard]] auto state() { return std::tie(path, backwards); }
};

// Returns the stretches of a path: a piece is driven backwards if the robot looks away from where it leads.
std::vector<Stretch> stretches_of(const orca::idl::Path& path) {
  std::vector<Stretch> stretches;
  std::vector<Vec2> points;
  bool backwards = false;
  const auto end_stretch = [&] {
    if (points.size() > 1) stretches.push_back({orca::nav::Path(points), backwards});
  };
  for (std::size_t i = 0; i < path.poses().size(); ++i) {
    const Pose2 pose = orca::plane_pose(path.poses()[i]);
    if (!points.empty() && norm(pose.position() - points.back()) > 1e-6) {
      const bool back = dot(pose.position() - points.back(), orca::direction(pose.yaw)) < 0.0;
      if (points.size() > 1 && back != backwards) {
        end_stretch();
        points = {points.back()};
      }
      backwards = back;
    }
    points.push_back(pose.position());
  }
  end_stretch();
  return stretches;
}

// Returns whether another behaviour, which can do better there, takes the robot through a door.
bool takes_over(const orca::ObjectPtr<orca::idl::MotionCommand>& wish, orca::TimePoint now) {
  constexpr double kStale = 0.3;  // [s]
  return wish && wish->kind() != orca::idl::DONTCARE &&
         (wish->kind() == orca::idl::FULLSTOP || wish->weight() > 0.0) &&
         orca::to_seconds(now - orca::to_time_point(wish->creation_time())) < kStale;
}

/// A behaviour that drives to goals on paths that a PathPlanner finds (thesis 11.1, Pilot). See README.md.
class Pilot final : public orca::go::GoalFollower {
 public:
  explicit Pilot(orca::ComponentHost& host) : GoalFollower(host, kBlockedAfter) {}

 private:
  static constexpr double kBlockedAfter = 60.0;  // [s]
  static constexpr double kDeafAfter = 0.6;      // [s]
  static constexpr double kBrakes = 0.8;         // of the change of speed that the base is capable of
  static constexpr double kSame = 0.05;          // [m]

  Status configure() override {
    if (!layer_->empty()) {
      orca::Result<orca::nav::FloorRules> rules = orca::planning::read_layer(*layer_);
      if (!rules) return layer_.refuse(rules.error().message);
      rules_ = std::move(*rules);
    }
    if (const Status sound = robot_.check(); !sound.ok()) return sound;
    if (const Status sound = recoveries_.check(); !sound.ok()) return sound;
    return GoalFollower::configure();
  }

  Status start() override {
    if (Status begun = GoalFollower::start(); !begun.ok()) return begun;
    driver_.reset();
    heard_at_.reset();
    drop_path();
    return robot_.ask();
  }

  Status params_changed() override {
    if (const Status sound = recoveries_.check(); !sound.ok()) return sound;
    if (driver_) driver_->set_recoveries(recoveries_.order());
    return orca::ok();
  }

  void stop() override {
    robot_.leave();
    recoveries_.note(std::nullopt);
    GoalFollower::stop();
  }

  // A successor that has this drives on where this object would have driven. Around it is what came last at `world`.
  void save_state(orca::StateWriter& state) const override {
    GoalFollower::save_state(state);
    state.write(robot_.body(), stretches_, at_, driven_for_, heard_at_, driver_.has_value());
    if (driver_) state.write(*driver_);
  }

  Status load_state(orca::StateReader& state) override {
    if (Status read = GoalFollower::load_state(state); !read.ok()) return read;
    auto [body] = robot_.state();
    bool has_driver = false;
    Status read = state.read(body, stretches_, at_, driven_for_, heard_at_, has_driver);
    if (!read.ok()) return read;
    if (const auto around = world_.latest(); !around || !floor_.take(*around).ok()) heard_at_.reset();
    if (!has_driver) return read;
    driver_.emplace(footprint(), recoveries_.order());
    return std::apply([&](auto&... part) { return state.read(part...); }, driver_->state());
  }

  [[nodiscard]] std::uint32_t state_version() const override { return 4; }

  orca::Outcome work() override {
    if (const Status learnt = robot_.learn(); !learnt.ok()) return orca::failed(learnt.error().text());
    if (!driver_ && robot_.body()) driver_.emplace(footprint(), recoveries_.order());
    while (world_.new_data_arrived()) take_world(*world_.get_update());
    return GoalFollower::work();
  }

  void take_world(const OccupancyGrid& grid) {
    if (const Status taken = floor_.take(grid); !taken.ok()) return log_warning(taken.error().message);
    heard_at_ = now();
  }

  std::optional<Pose2> take_pose() override {
    const auto pose = GoalFollower::take_pose();
    if (localizer().connected()) {
      note_motion(*localizer().latest());
    } else {
      note_motion(*odometry().latest());
    }
    return pose;
  }

  template <typename Motion>
  void note_motion(const Motion& motion) {
    twist_ = {motion.translational_velocity(), motion.sideways_velocity(), motion.steering_velocity()};
  }

  void drop_path() {
    stretches_.clear();
    at_ = 0;
    if (driven_for_) dropped_for_ = driven_for_;
    driven_for_.reset();
  }

  void idle() override {
    drop_path();
    recoveries_.note(std::nullopt);
    if (driver_) driver_->reset();
  }

  void drive(const Pose2& pose, const Target& target) override {
    // It leaves the robot to who drives through doors, and to nobody while the motors are held.
    if (orca::are_motors_held(kept_alarms()) || takes_over(traverse_.latest(), now())) {
      motion().push(orca::dont_care());
      note_speed(0.0);
      recoveries_.note(std::nullopt);
      if (driver_) {
        driver_->reset();
        driver_->begin({now(), pose, twist_});  // it has waited for nobody
      }
      return;
    }
    const bool hears = driver_ && heard_at_ && orca::to_seconds(now() - *heard_at_) <= kDeafAfter;
    if (!hears) return stand();
    take_path(pose, target);
    see_obstacles(pose);
    const Moment moment{now(), pose, twist_};
    const bool rests = !steers() || !target.use_orientation || is_at_end();
    if (const auto step = rests ? step_of_rest(target, pose, deceleration(), before()) : std::nullopt) {
      if (!steers() || step->kind != Step::Kind::turn) return rest(*step, pose, target);
    }
    const auto steer = driver_->recover(moment, pursuit(), [&](Vec2 point) { return is_known(point); });
    note_recovery();
    if (steer) return command(*steer);
    driver_->note(pose);
    if (stretches_.empty()) return stand();
    follow(moment, target);
  }

  // Who keeps the map is asked to doubt it.
  void note_recovery() {
    recoveries_.note(driver_->recovery());
    if (!doubts(driver_->recovery()) || !doubt_.connected()) return;
    if (const Status sent = doubt_.send(doubt_.loan()); !sent.ok()) log_warning(sent.error().text());
  }

  void stand() {
    motion().push(orca::full_stop());
    note_speed(0.0);
  }

  void command(const Steer& steer) {
    motion().push(orca::turn(steer.turn_rate, steer.speed, weight()));
    note_speed(steer.speed);
  }

  // Takes over the path for this target. One for another target, which comes late, does not count.
  void take_path(const Pose2& pose, const Target& target) {
    if (!driven_for_ || norm(*driven_for_ - target.place) > kSame) {
      drop_path();
      driven_for_ = target.place;
      begun_at_ = now();
      if (path_.new_data_arrived()) (void)path_.get_update();
      driver_->begin({now(), pose, twist_});
    }
    if (!path_.new_data_arrived()) return;
    const auto path = path_.get_update();
    if (is_late(*path, target)) return;
    stretches_ = stretches_of(*path);
    at_ = 0;
    driver_->begin_path();
  }

  // Returns whether a path leads to the target before, as the planner had not heard yet of this one.
  [[nodiscard]] bool is_late(const orca::idl::Path& path, const Target& target) const {
    constexpr orca::Duration kHeard = std::chrono::milliseconds(300);  // within a few of its laps
    if (!dropped_for_ || norm(*dropped_for_ - target.place) < kSame) return false;
    return now() - begun_at_ < kHeard && !path.poses().empty() &&
           norm(orca::plane_pose(path.poses().back()).position() - *dropped_for_) < kSame;
  }

  // Collects what is near the robot.
  void see_obstacles(const Pose2& pose) {
    const auto& grid = floor_.grid();
    const double reach = footprint().outer_radius() + pursuit().max_look_ahead * 1.5 + 0.3;
    const Vec2 robot = seen_from(floor_.X_WM(), pose.position());
    const orca::nav::Cell low = grid.lattice.cell_at(robot - Vec2{reach, reach});
    const orca::nav::Cell high = grid.lattice.cell_at(robot + Vec2{reach, reach});
    driver_->points().clear();
    for (int row = low.row; row <= high.row; ++row)
      for (int column = low.column; column <= high.column; ++column)
        if (grid.occupied({column, row}))
          driver_->points().push_back(floor_.X_WM() * grid.lattice.middle_of({column, row}));
  }

  // Returns whether it is known what is there. Obstacles are looked at one by one.
  [[nodiscard]] bool is_known(Vec2 point) const {
    const auto& grid = floor_.grid();
    const orca::nav::Cell cell = grid.lattice.cell_at(seen_from(floor_.X_WM(), point));
    return grid.free(cell) || grid.occupied(cell);
  }

  // Follows the present stretch; at its end the robot stops and begins the next.
  void follow(const Moment& moment, const Target& target) {
    constexpr double kEnd = 0.06;  // [m]
    driver_->find_place(stretches_[at_].path, moment.pose.position());
    const bool more = at_ + 1 < stretches_.size();
    if (more && stretches_[at_].path.length() - driver_->along() < kEnd) {
      ++at_;
      driver_->begin_path();
    }
    const Stretch& stretch = stretches_[at_];
    const Vec2 end = stretch.path.points().back();
    const bool passes = target.via && at_ + 1 == stretches_.size() && norm(end - target.place) < kSame;
    const double limit = speed_limit(stretch.path, moment.pose);
    orca::nav::Pursuit manner = pursuit();
    manner.max_speed = std::min(manner.max_speed, limit);
    Moment facing = moment;
    if (stretch.backwards) {  // as one that looks the other way would drive
      facing.pose.yaw = orca::wrapped(facing.pose.yaw + std::numbers::pi);
      facing.twist = {-moment.twist.forward, -moment.twist.left, moment.twist.turn_rate};
    }
    const bool leads_there = at_ + 1 < stretches_.size() || norm(end - target.place) < kSame;
    Steer steer = driver_->follow_path(stretch.path, facing, manner,
                                       {passes ? manner.max_speed : 0.0, kPatience, leads_there});
    if (stretch.backwards) steer.speed = -steer.speed;
    command(steer);
    double left = -driver_->along();
    for (std::size_t i = at_; i < stretches_.size(); ++i) left += stretches_[i].path.length();
    note_plan(left);
  }

  // Returns the speed from which the robot can be as slow as each slow zone ahead demands when it gets there [m/s].
  [[nodiscard]] double speed_limit(const orca::nav::Path& path, const Pose2& pose) const {
    constexpr double kStep = 0.1;  // [m]
    double limit = rules_.speed_at(pose.position()).value_or(*max_speed_);
    const double brakes = deceleration();
    const double reach = 0.5 * limit * limit / brakes + 2.0 * kStep + *max_speed_ * pursuit().delay;
    for (double way = 0.0; way < reach; way += kStep) {
      const auto there = rules_.speed_at(path.at(driver_->along() + way));
      const double free = std::max(0.0, way - kStep - *max_speed_ * pursuit().delay);
      if (there) limit = std::min(limit, std::sqrt(*there * *there + 2.0 * brakes * free));
    }
    return limit;
  }

  // Returns whether the path is as good as driven.
  [[nodiscard]] bool is_at_end() const {
    constexpr double kEnd = 0.1;  // [m]
    return !stretches_.empty() && at_ + 1 == stretches_.size() &&
           stretches_[at_].path.length() - driver_->along() < kEnd;
  }

  // Comes to rest within reach of a goal, but not by driving into something.
  void rest(Step step, const Pose2& pose, const Target& target) {
    const double room = driver_->room_ahead(pose, pursuit().margin);
    step.speed = std::min(step.speed, orca::nav::speed_to_stop_within(room, deceleration(), pursuit().delay));
    if (step.kind == Step::Kind::reached) idle();
    take(step, pose, target);
  }

  [[nodiscard]] bool steers() const { return *turning_radius_ > 0.0; }

  [[nodiscard]] orca::nav::Footprint footprint() const {
    return robot_.body().value_or(orca::planning::Body{}).outline();
  }

  [[nodiscard]] double deceleration() const {
    constexpr double kCareful = 0.5;  // [m/s2]
    const auto& body = robot_.body();
    return body && body->acceleration > 0.0 ? kBrakes * body->acceleration : kCareful;
  }

  [[nodiscard]] orca::nav::Pursuit pursuit() const {
    const orca::planning::Body body = robot_.body().value_or(orca::planning::Body{});
    orca::nav::Pursuit pursuit;
    pursuit.max_speed = at_most(*max_speed_, body.max_speed);
    pursuit.turn_rate = at_most(kTurnRate, body.max_rate);
    pursuit.deceleration = deceleration();
    pursuit.turning_radius = *turning_radius_;
    if (steers()) {  // It must keep to arcs and to the direction at their end.
      pursuit.look_ahead_time = 0.5;
      pursuit.min_look_ahead = 0.15;
    }
    return pursuit;
  }

  static constexpr double kTurnRate = 1.5;  // [rad/s]
  static constexpr double kPatience = 1.0;  // [s] of standing blocked before it recovers

  orca::PushProxy<orca::idl::Path> path_{
      *this, "path", {.text = "The way to what GoalPush says, as a PathPlanner finds it."}};
  orca::PushProxy<OccupancyGrid> world_{
      *this, "world", {.text = "What is around the robot, and parts of it that have changed."}};
  orca::SendProxy<orca::idl::Ask> doubt_{
      *this,
      "doubt",
      {.text = "Receiver of the wish to doubt what it has seen: a WorldModel.", .optional = true}};
  orca::PushProxy<orca::idl::MotionCommand> traverse_{
      *this,
      "traverse",
      {.text = "Wishes of a TraverseDoor; while it has any, the Pilot has none.", .optional = true}};
  orca::planning::AskedRobot robot_{*this};
  orca::planning::Recoveries recoveries_{*this, host()};
  orca::Param<double> max_speed_{
      *this, "max_speed", 0.5, {.unit = "m/s", .min = 0.0, .text = "Largest speed."}};
  orca::Param<double> turning_radius_{
      *this,
      "turning_radius",
      0.0,
      {.unit = "m",
       .min = 0.0,
       .text = "Radius of the smallest circle that the robot drives; 0: it can turn on the spot."}};
  orca::Param<std::string> layer_{
      *this,
      "layer",
      "",
      {.file = true,
       .fixed = true,
       .text = "File of slow zones, the same as PathPlanner has; empty: there are none."}};

  orca::planning::Floor floor_{orca::planning::Floor::kMostToPlan};
  orca::nav::FloorRules rules_;                  // in the frame of the goals
  std::optional<orca::nav::PathDriver> driver_;  // from when the outline is known
  std::vector<Stretch> stretches_;
  std::size_t at_ = 0;  // the stretch that it drives on
  std::optional<Vec2> driven_for_;
  orca::TimePoint begun_at_{};       // to drive for that
  std::optional<Vec2> dropped_for_;  // the one before
  std::optional<orca::TimePoint> heard_at_;
  orca::Twist2 twist_;
};

}  // namespace

ORCA_COMPONENT(Pilot, "orca.Pilot")
