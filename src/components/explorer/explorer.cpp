// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "frontiers.hpp"
#include "orca/component.hpp"
#include "orca/component/held_motors.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/goals/goal_relay.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/planning/asked_robot.hpp"
#include "orca/planning/floor.hpp"

namespace {

using orca::Pose2;
using orca::Vec2;
using orca::explore::Frontier;
using orca::idl::GoalPoint;

/// A component that lets a robot see all of a building that it can reach. It takes goals in the place of a planner, to which it passes them on;
/// at a goal with the name `explore_at` it first drives from frontier to frontier of the map, until none is left. See README.md.
class Explorer final : public orca::Component {
 public:
  explicit Explorer(orca::ComponentHost& host) : Component(host) { lap_on(localizer_); }

 private:
  enum class Turn : std::uint8_t { due, on, done };

  orca::Status configure() override { return robot_.check(); }

  orca::Status start() override { return robot_.ask(); }
  void stop() override { robot_.leave(); }

  orca::Status on_goal(const orca::ObjectPtr<GoalPoint>& goal) {
    if (orca::Status sound = relay_.keep(goal); !sound.ok()) return sound;
    towards_.reset();
    reached_.reset();
    left_out_.clear();
    explores_ = !goal->via() && goal->name() == *explore_at_;
    began_ = now();
    empty_looks_ = 0;
    turn_ = Turn::due;
    looked_ = {};
    return explores_ ? orca::ok() : relay_.pass_on(copy_value(goal));
  }

  orca::Outcome work() override {
    if (const orca::Status learnt = robot_.learn(); !learnt.ok()) return orca::failed(learnt.error().text());
    const auto here = localizer_.get_update();
    while (map_.new_data_arrived())
      if (const orca::Status taken = floor_.take(*map_.get_update()); !taken.ok())
        log_warning(taken.error().message);
    while (const auto arrived = relay_.next_arrival()) hear(*arrived);
    while (const auto failed = relay_.next_failure()) hear(*failed);
    const orca::Duration held = held_.since_last(now(), kept_alarms());
    patient_until_ += held;
    began_ += held;
    if (is_over()) relay_.end();
    if (!relay_.goal() || !explores_ || !senders_.accepts(*here)) return orca::again();
    if (!robot_.body() || now() < looked_ + kEvery || known_area() <= 0.0) return orca::again();
    looked_ = now();
    const orca::Pose2 pose = orca::plane_pose(*here);
    if (turn_ == Turn::due) turn(pose);
    if (turn_ == Turn::done) look(pose.position());
    return orca::again();
  }

  // Returns whether the time of the goal is over: who has sent it has given it up.
  [[nodiscard]] bool is_over() const {
    return relay_.goal() && explores_ && relay_.goal()->time_limit() > 0.0 &&
           now() > began_ + orca::from_seconds(relay_.goal()->time_limit());
  }

  void hear(const orca::idl::Arrived& arrived) {
    if (turn_ == Turn::on) return void(turn_ = Turn::done);
    if (explores_) return void(reached_ = now());
    relay_.end_as(arrived);
  }

  void hear(const orca::idl::GoalFailed& failed) {
    if (turn_ == Turn::on) return void(turn_ = Turn::done);
    if (explores_) return leave_out(failed.reason());
    relay_.end_as(failed, failed.name());
  }

  void leave_out(const std::string& reason) {
    if (!towards_) return;
    char place[64];
    std::snprintf(place, sizeof place, "(%.2f, %.2f) m", towards_->x, towards_->y);
    log_info("the border of what is known at " + std::string(place) + " is left out: " + reason);
    left_out_.push_back(*towards_);
    towards_.reset();
    reached_.reset();
    looked_ = {};
  }

  // Lets the robot look behind itself: its laser may see the half of what is around it.
  void turn(const Pose2& pose) {
    turn_ = Turn::on;
    auto point = point_of_its_own();
    point->name() = "behind";
    point->coordinate().point().x(pose.x);
    point->coordinate().point().y(pose.y);
    point->reach_radius().distance(kNear);
    point->use_orientation(true);
    point->orientation().orientation().yaw(orca::wrapped(pose.yaw + std::numbers::pi));
    point->reach_angle(kTurned);
    send(std::move(point));
  }

  // Drives to the nearest frontier, and to the goal when there is none.
  void look(Vec2 robot) {
    if (reached_ && now() < *reached_ + kSettle) return;
    std::vector<Vec2> places = frontiers_from(robot);
    if (towards_ && holds(places, *towards_, kSame)) {
      if (!reached_ && now() < patient_until_) return;
      leave_out(reached_ ? "from nearby nothing more is seen there" : "it takes too long");
      places = frontiers_from(robot);
    }
    // One look may be wrong: a single echo beside the robot shuts it in.
    empty_looks_ = places.empty() ? empty_looks_ + 1 : 0;
    if (empty_looks_ == kEmptyLooks) return conclude();
    if (!places.empty()) drive_to(places.front(), robot);
  }

  // Returns the places of those that are not left out, the nearest first.
  [[nodiscard]] std::vector<Vec2> frontiers_from(Vec2 robot) const {
    const orca::planning::Body& body = *robot_.body();
    const double clearance = (body.width > 0.0 ? 0.5 * body.width : body.radius) + kSpare;
    const Pose2 X_WM = floor_.X_WM();
    std::vector<Vec2> places;
    for (const Frontier& one :
         orca::explore::frontiers(floor_.grid(), clearance, inverse(X_WM) * robot, *least_width_))
      if (!holds(left_out_, X_WM * one.place, kNear)) places.push_back(X_WM * one.place);
    return places;
  }

  [[nodiscard]] static bool holds(const std::vector<Vec2>& places, Vec2 place, double within) {
    return std::ranges::any_of(places, [&](Vec2 one) { return norm(one - place) < within; });
  }

  void drive_to(Vec2 place, Vec2 robot) {
    towards_ = place;
    reached_.reset();
    patient_until_ = now() + kPatience + orca::from_seconds(norm(place - robot) / kSlow);
    auto point = point_of_its_own();
    point->coordinate().point().x(place.x);
    point->coordinate().point().y(place.y);
    point->name() = "border_" + std::to_string(++drives_);
    point->reach_radius().distance(kNear);
    point->use_orientation(false);
    send(std::move(point));
  }

  // Returns a goal of another mission: a planner that has given up one takes nothing more of its mission.
  orca::Loan<GoalPoint> point_of_its_own() {
    auto point = orca::make_object(*relay_.goal());
    point->mission(begin_mission());
    point->time_limit(0.0);
    return point;
  }

  void conclude() {
    const double area = known_area();
    char text[64];
    std::snprintf(text, sizeof text, "%.0f m2 are known to be free", area);
    log_info(
        "nothing new can be reached; " + std::string(text) +
        (left_out_.empty() ? "" : ", and " + std::to_string(left_out_.size()) + " places were left out"));
    explores_ = false;
    towards_.reset();
    send(orca::make_object(*relay_.goal()));
  }

  [[nodiscard]] double known_area() const {
    const auto& map = floor_.grid();
    const auto free = std::ranges::count_if(
        map.cells, [](std::uint8_t cell) { return cell < orca::nav::FloorGrid::kOccupied; });
    return static_cast<double>(free) * map.lattice.side * map.lattice.side;
  }

  void send(orca::Loan<GoalPoint> point) {
    if (const orca::Status sent = relay_.pass_on(std::move(point)); !sent.ok()) {
      relay_.report_failure(orca::idl::GOAL_REFUSED, "refused: " + sent.error().text());
      relay_.end();
    }
  }

  void save_state(orca::StateWriter& state) const override {
    state.write(relay_.task(), began_, turn_, explores_, drives_, left_out_, floor_);
  }
  orca::Status load_state(orca::StateReader& state) override {
    return state.read(relay_.task(), began_, turn_, explores_, drives_, left_out_, floor_);
  }

  static constexpr orca::Duration kEvery = std::chrono::seconds(1);      // it looks for frontiers
  static constexpr orca::Duration kPatience = std::chrono::seconds(90);  // for the way to one of them, and
  static constexpr double kSlow = 0.1;  // [m/s] for each metre of it straight on
  static constexpr int kEmptyLooks = 3;
  static constexpr orca::Duration kSettle =
      std::chrono::seconds(2);            // for what is seen there to come into the map
  static constexpr double kTurned = 0.2;  // [rad] off the direction behind it
  static constexpr double kNear = 0.4;    // [m] from a frontier all is seen that can be
  static constexpr double kSame = 0.6;    // [m] between two places at one frontier
  static constexpr double kSpare = 0.05;  // [m] beside the robot

  orca::go::GoalRelay relay_{
      *this,
      host(),
      &Explorer::on_goal,
      {.driver = "a planner",
       .done = "One object per goal reached, after all that could be reached was seen.",
       .undone = "One object per goal not reached."}};

  orca::PushProxy<orca::idl::RobotPose> localizer_{
      *this, "localizer", {.text = "Pose of the robot, in the frame of the map."}};
  orca::PushProxy<orca::idl::OccupancyGrid> map_{
      *this,
      "map",
      {.text = "The map as far as it is made, and parts of it that have changed: a SlamLocalizer."}};
  orca::planning::AskedRobot robot_{*this};

  orca::Param<std::string> explore_at_{
      *this, "explore_at", "explore", {.text = "Name of the goals before which everything is to be seen."}};
  orca::Param<double> least_width_{
      *this,
      "least_width",
      0.4,
      {.unit = "m", .min = 0.05, .text = "Borders of what is known that are narrower are not driven to."}};

  orca::planning::Floor floor_{orca::planning::Floor::kMostToPlan, orca::planning::Floor::Edge::grows};
  orca::TimePoint began_{};
  Turn turn_ = Turn::due;
  bool explores_ = false;        // it has not seen everything
  std::uint32_t drives_ = 0;     // to frontiers
  std::optional<Vec2> towards_;  // the frontier that the robot drives to, world frame
  orca::TimePoint patient_until_{};
  int empty_looks_ = 0;  // one after the other
  std::optional<orca::TimePoint> reached_;
  std::vector<Vec2> left_out_;  // world frame
  orca::TimePoint looked_{};
  orca::SenderWatch senders_{host()};
  orca::HeldTime held_;
};

}  // namespace

ORCA_COMPONENT(Explorer, "orca.Explorer")
