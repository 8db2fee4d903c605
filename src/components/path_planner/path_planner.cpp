// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/portable_math.hpp"
#include "orca/component.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/navigation/hybrid_planner.hpp"
#include "orca/navigation/path_planner.hpp"
#include "orca/planning/asked_robot.hpp"
#include "orca/planning/floor.hpp"
#include "orca/planning/layer_file.hpp"

namespace {

using orca::ObjectPtr;
using orca::Pose2;
using orca::Vec2;
using orca::idl::GoalPoint;
using orca::idl::OccupancyGrid;
using orca::idl::Path;
using orca::nav::SteeredGoal;

constexpr double kSpacing = 0.1;  // [m] of the poses of a path

/// A planner of ways through a map (thesis 11.1): grid search for robots that turn on the spot, Hybrid-A* for others. See README.md.
class PathPlanner final : public orca::Component {
 public:
  explicit PathPlanner(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status configure() override {
    lap_on("localizer");
    if (!layer_->empty()) {
      orca::Result<orca::nav::FloorRules> rules = orca::planning::read_layer(*layer_);
      if (!rules) return layer_.refuse(rules.error().message);
      rules_ = std::move(*rules);
    }
    return robot_.check();
  }

  orca::Status start() override {
    drop_plan();
    return robot_.ask();
  }

  void stop() override { robot_.leave(); }

  orca::Outcome work() override {
    if (const orca::Status learnt = robot_.learn(); !learnt.ok()) return orca::failed(learnt.error().text());
    const auto pose = localizer_.get_update();
    while (world_.new_data_arrived()) take_world(*world_.get_update());
    if (!senders_.accepts(*pose)) return orca::again();
    X_WR_ = orca::plane_pose(*pose);
    stands_ = orca::portable::hypot(pose->translational_velocity(), pose->sideways_velocity()) < kSlow &&
              std::fabs(pose->steering_velocity()) < kSlow;
    if (!stands_) moved_at_ = now();
    const auto goal = goal_.latest();
    const bool drives = goal && orca::to_seconds(now() - orca::to_time_point(goal->creation_time())) < kStale;
    const bool has_new_subscribers = paths_.take_new_subscribers();
    if (!drives || has_new_subscribers) drop_plan();  // who comes later gets a path from here
    if (drives && !floor_.grid().cells.empty() && robot_.body()) keep_plan(*goal);
    return orca::again();
  }

  void take_world(const OccupancyGrid& grid) {
    if (const orca::Status taken = floor_.take(grid); !taken.ok()) log_warning(taken.error().message);
  }

  void drop_plan() {
    planned_for_.reset();
    kept_.drop();
    steered_ = {};
  }

  [[nodiscard]] orca::nav::Footprint footprint() const {
    return robot_.body().value_or(orca::planning::Body{}).outline();
  }

  // Returns a goal in the frame of the cells.
  [[nodiscard]] SteeredGoal in_map(const GoalPoint& goal) const {
    const Pose2 X_MW = inverse(floor_.X_WM());
    const auto& point = goal.coordinate().point();
    SteeredGoal result{X_MW * Vec2{point.x(), point.y()}, std::nullopt};
    if (goal.use_orientation() && !goal.via())
      result.yaw = orca::wrapped(X_MW.yaw + goal.orientation().orientation().yaw());
    return result;
  }

  // Plans if there is another goal, and now and then in case there is a better way.
  void keep_plan(const GoalPoint& goal) {
    constexpr double kSame = 0.05;  // [m]
    const SteeredGoal to = in_map(goal);
    const bool other = !planned_for_ || norm(*planned_for_ - to.place) > kSame;
    if (!other && orca::to_seconds(now() - planned_at_) < *replan_every_) return;
    if (other) drop_plan();
    planned_for_ = to.place;
    planned_at_ = now();
    const orca::nav::OccupancyMap map(floor_.grid());
    if (steers() ? renew_steered(map, to, other) : renew(map, to)) push(goal);
  }

  [[nodiscard]] bool steers() const { return *turning_radius_ > 0.0; }
  [[nodiscard]] Pose2 robot_in_map() const { return seen_from(floor_.X_WM(), X_WR_); }

  bool renew(const orca::nav::OccupancyMap& map, const SteeredGoal& to) {
    const Vec2 robot = robot_in_map().position();
    if (!map.lattice().holds(map.lattice().cell_at(robot))) return false;
    const orca::nav::Path& path = kept_.plan().path;
    const double along = path.empty() ? 0.0 : path.nearest(robot, 0.0, path.length());
    const orca::nav::FloorRules rules = rules_.in(inverse(floor_.X_WM()));
    const bool blocked = now() - moved_at_ > kBlocked;
    return kept_.renew({map, footprint(), wishes_, robot, to.place, along, blocked, &rules});
  }

  void look_at(const orca::nav::OccupancyMap& map, Vec2 robot) {
    costs_.look_at(map, footprint(), wishes_);
    costs_.obey(map.lattice(), rules_.in(inverse(floor_.X_WM())), robot);
    if (steers())
      hybrid_.look_at(map, footprint(), costs_.costs(), costs_.forbidden(), kEasier * *turning_radius_,
                      kMargin);
  }

  // A way of a robot that steers is kept as long as it is free and the robot is on it.
  bool renew_steered(const orca::nav::OccupancyMap& map, const SteeredGoal& to, bool other) {
    const Pose2 robot = robot_in_map();
    look_at(map, robot.position());
    if (!other && is_still_free(robot)) return false;
    steered_ = hybrid_.plan(robot, to);
    steered_from_ = robot;
    return true;
  }

  // Returns whether the rest of the way may be driven from its pose nearest to the robot, which must be near. A robot that stands needs a new
  // way: it may have come to the end in another direction.
  [[nodiscard]] bool is_still_free(const Pose2& robot) const {
    constexpr double kOff = 0.25;  // [m]
    if (stands_) return false;
    const std::vector<Pose2> poses = poses_of(steered_from_, steered_);
    const auto nearest = std::ranges::min_element(poses, {}, [&](const Pose2& pose) {
      return norm(pose.position() - robot.position()) +
             *turning_radius_ * std::fabs(orca::wrapped(pose.yaw - robot.yaw));
    });
    if (norm(nearest->position() - robot.position()) > kOff) return false;
    return steered_.complete && std::all_of(nearest, poses.end(), [&](const Pose2& pose) {
             return hybrid_.outline().touched(pose) == 0;
           });
  }

  // Returns the poses on a way, at most kSpacing apart, and where pieces end.
  [[nodiscard]] static std::vector<Pose2> poses_of(Pose2 pose, const orca::nav::SteeredPlan& plan) {
    std::vector<Pose2> poses{pose};
    for (const orca::nav::WayPiece& piece : plan.pieces) {
      const int steps = std::max(1, static_cast<int>(std::ceil(std::fabs(piece.length) / kSpacing)));
      for (int i = 0; i < steps; ++i) {
        pose = driven(pose, piece, piece.length / steps);
        poses.push_back(pose);
      }
    }
    return poses;
  }

  [[nodiscard]] static std::vector<Pose2> poses_of(const orca::nav::Path& path) {
    std::vector<Pose2> poses;
    for (const Vec2 point : path.points()) poses.push_back({point.x, point.y, 0.0});
    for (std::size_t i = 0; i < poses.size(); ++i)
      poses[i].yaw = path.heading(path.nearest(poses[i].position(), 0.0, path.length()));
    return poses;
  }

  void fill(const std::vector<Pose2>& poses, const GoalPoint& goal, Path& path) const {
    path.name(goal.name());
    for (const Pose2& pose : poses)
      path.poses().push_back(orca::level_pose(floor_.X_WM() * pose, 0.0, orca::TimePoint{}));
  }

  void push(const GoalPoint& goal) {
    auto path = paths_.loan();
    fill(steers() ? poses_of(steered_from_, steered_) : poses_of(kept_.plan().path), goal, *path);
    paths_.push(std::move(path));
  }

  // Returns the poses on a way from the robot, whatever the plan for the Pilot is; nothing: no way leads there.
  std::optional<std::vector<Pose2>> whole_way(const SteeredGoal& to) {
    const orca::nav::OccupancyMap map(floor_.grid());
    const Pose2 robot = robot_in_map();
    if (!map.lattice().holds(map.lattice().cell_at(robot.position()))) return std::nullopt;
    look_at(map, robot.position());
    if (steers()) {
      const orca::nav::SteeredPlan plan = hybrid_.plan(robot, to);
      return plan.complete ? std::optional(poses_of(robot, plan)) : std::nullopt;
    }
    const orca::nav::Plan plan = costs_.plan(map, robot.position(), to.place);
    return plan.complete ? std::optional(poses_of(plan.path)) : std::nullopt;
  }

  orca::Result<orca::Loan<Path>> on_question(const ObjectPtr<GoalPoint>& goal) {
    if (floor_.grid().cells.empty() || !robot_.body() || !localizer_.latest())
      return orca::fail(orca::Code::unavailable,
                        "it does not know the world, the robot or its pose yet; ask again later");
    const auto poses = whole_way(in_map(*goal));
    if (!poses)
      return orca::fail(orca::Code::not_found,
                        "no way leads to \"" + goal->name() + "\" as the world is known now");
    auto path = orca::make_object<Path>();
    fill(*poses, *goal, *path);
    return path;
  }

  static constexpr double kSlow = 0.02;  // [m/s], [rad/s]
  static constexpr double kEasier =
      1.15;  // radius of planned bends, relative to the smallest: who follows needs room to steer
  static constexpr orca::Duration kBlocked =
      std::chrono::milliseconds(500);      // of standing after which another way is planned
  static constexpr double kStale = 1.0;    // [s] after the last word of a goal nobody drives there any more
  static constexpr double kMargin = 0.02;  // [m] around the outline of a robot that steers

  orca::PushProxy<orca::idl::RobotPose> localizer_{
      *this, "localizer", {.text = "Pose of the robot, in the frame of the goals."}};
  orca::PushProxy<OccupancyGrid> world_{
      *this, "world", {.text = "The map by which it plans, and parts of it that have changed."}};
  orca::PushProxy<GoalPoint> goal_{
      *this,
      "goal",
      {.text = "The place to plan a way to, again and again, as a Pilot says it.", .optional = true}};
  orca::planning::AskedRobot robot_{*this};
  orca::PushServer<Path> paths_{
      *this, "PathPush", {.text = "The way to the goal, whenever it becomes another one."}};
  orca::QueryServer<GoalPoint, Path> question_{
      *this, "PathQuery", &PathPlanner::on_question, {.text = "The way from the robot to a goal."}};
  orca::Param<double> turning_radius_{
      *this,
      "turning_radius",
      0.0,
      {.unit = "m",
       .min = 0.0,
       .text = "Radius of the smallest circle that the robot drives; 0: it can turn on the spot."}};
  orca::Param<double> replan_every_{
      *this,
      "replan_every",
      0.5,
      {.unit = "s", .min = 0.05, .text = "Time after which it looks for a better path."}};
  orca::Param<std::string> layer_{
      *this,
      "layer",
      "",
      {.file = true,
       .fixed = true,
       .text = "File of zones to keep out of, slow zones and lanes; empty: there are none."}};

  orca::planning::Floor floor_{orca::planning::Floor::kMostToPlan};
  orca::nav::FloorRules rules_;  // in the frame of the goals
  orca::nav::PlanWishes wishes_;
  orca::nav::KeptPlan kept_{orca::nav::kShortest};
  orca::nav::PathPlanner costs_{orca::nav::kShortest};
  orca::nav::HybridPlanner hybrid_;
  orca::nav::SteeredPlan steered_;
  Pose2 steered_from_;  // in the frame of the cells
  Pose2 X_WR_;
  bool stands_ = true;
  orca::TimePoint moved_at_{};
  std::optional<Vec2> planned_for_;  // in the frame of the cells
  orca::TimePoint planned_at_{};
  orca::SenderWatch senders_{host()};
};

}  // namespace

ORCA_COMPONENT(PathPlanner, "orca.PathPlanner")
