// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "orca/component.hpp"
#include "orca/component/held_motors.hpp"
#include "orca/component/sender_life.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/geometry/objects/odometry_trust.hpp"
#include "orca/goals/legs.hpp"
#include "orca/goals/patience.hpp"
#include "orca/goals/route.hpp"
#include "orca/goals/target.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"

namespace orca::go {

/// Checks whether a reading says where the robot is, and not where it was a second ago.
/// @errors  invalid_argument.
/// @thread  pure function; any thread.
[[nodiscard]] inline Status check_present(TimePoint now, const idl::TimeValue& stamp) {
  constexpr double kOldest = 1.0;  // [s]
  return check_age(to_seconds(now - to_time_point(stamp)), kOldest);
}

/// The common part of behaviours that drive to goals (thesis 11.1): it takes goals, refuses what no robot on the floor can do,
/// passes via points, says when the robot has arrived, and gives up what cannot be reached. A derived class does the driving.
///
/// Via points that come before a goal are passed in order. A point that comes when the route already ends in
/// a goal, or belongs to another mission, replaces the whole route. Doors are driven through in a straight line.
/// While somebody subscribes to its failures it gives up goals that it cannot reach. It has not arrived as long as it
/// does not know well enough where it is.
///
/// The pose comes from the localizer or, without one, from the odometry; it starts the laps. Another behaviour
/// that drives to goals and takes its place while the robot drives gets its knowledge.
///
/// Thread contract: as every component.
class GoalFollower : public Component {
 protected:
  /// @param blocked_after [s]  default of the parameter.
  GoalFollower(ComponentHost& host, double blocked_after);

  /// Drives towards a target, for one lap: pushes one command, or calls rest() or stand().
  /// @param pose  of the robot, in the frame of the goals.
  virtual void drive(const Pose2& pose, const Target& target) = 0;
  /// Takes note that there is nothing to drive to.
  virtual void idle() {}
  /// Says what must hold the robot where it is, for people; empty if nothing does. Called for a goal that is given up as blocked.
  [[nodiscard]] virtual std::string what_holds() const { return {}; }
  /// Forgets where things are: the robot is lost, or its odometry counts from another place.
  virtual void forget_places() {}

  /// Takes over a step of step_of_rest(), or one like it: pushes its command, or announces the arrival.
  void take(const Step& step, const Pose2& pose, const Target& target);
  /// Returns what step_of_rest() needs of the lap before.
  [[nodiscard]] const Before& before() const { return before_; }
  /// Takes note of the speed [m/s] commanded in this lap, by a command that take() has not pushed.
  void note_speed(double speed) { before_ = {false, speed, before_.time}; }

  /// Takes note of what is left of its plan [m]; nothing while it has none. Whoever plans says so each lap: the way around what is in
  /// the way may lead away from the goal at first, and is progress all the same.
  void note_plan(std::optional<double> left) { patience_.note_plan(left); }

  [[nodiscard]] PushServer<idl::MotionCommand>& motion() { return motion_; }
  [[nodiscard]] PushProxy<idl::RobotPose>& localizer() { return localizer_; }
  [[nodiscard]] PushProxy<idl::Odometry>& odometry() { return odometry_; }
  [[nodiscard]] double weight() const { return *weight_; }
  /// Returns when the pose of this lap was measured. @pre  within drive().
  [[nodiscard]] TimePoint posed_at() const { return *posed_at_; }

  /// Takes note of when the pose of this lap was measured, and of how sure it is.
  void note_pose(const idl::TimeValue& stamp, const std::array<double, 9>& covariance);

  // A derived class that overrides these calls them too.
  Status configure() override;
  Status start() override;
  void stop() override;
  void save_state(StateWriter& state) const override;
  Status load_state(StateReader& state) override;
  Outcome work() override;
  /// Takes the pose of this lap. A derived class that overrides it calls this one or note_pose().
  /// @return nothing if the pose says nothing valid; the robot then stands.
  [[nodiscard]] virtual std::optional<Pose2> take_pose();
  /// Takes note of odometry, whose frame becomes another one if the base starts again.
  void note_odometry(const idl::Odometry& odometry);
  /// Returns whether a reading says anything valid; if it does not, says so in the log.
  template <class Reading>
  [[nodiscard]] bool is_valid(const Reading& reading) {
    return senders_.accepts(reading);
  }
  /// Says in the log what is wrong with a reading, if it is not ok.
  /// @return whether it is.
  template <class Reading>
  [[nodiscard]] bool is_valid(const Reading& reading, const Status& checked) {
    return senders_.accepts(checked, object_type<Reading>().name, reading.origin());
  }

 private:
  // The path as its subscribers have it.
  struct PathShown {
    std::uint64_t change = 0;  // of the route
    std::size_t to = 0;        // subscribers
  };

  Status on_goal(const ObjectPtr<idl::GoalPoint>& goal);
  Status on_cancel(const ObjectPtr<idl::GoalFailed>& order);
  Status refuse(const idl::GoalPoint& goal, const char* fault);
  void follow_route(const Pose2& pose);
  void push_path(const Pose2& pose);
  Result<Loan<idl::Progress>> on_question(const ObjectPtr<idl::Ask>& ask);
  [[nodiscard]] std::string why_it_waits() const;
  void push_goal(const Target& target);
  void pass_via_points(const Pose2& pose);
  const Target& next_place(const Pose2& pose);
  void arrive(const Pose2& pose);
  void wait_to_be_sure();
  bool is_lost();
  [[nodiscard]] std::string doubt() const;
  bool is_hopeless(const Pose2& pose);
  void end_route(idl::GoalFailure kind, const std::string& reason);
  void announce(const idl::GoalPoint& goal, idl::GoalFailure kind, const std::string& reason);

  SendServer<idl::GoalPoint> goal_;
  SendServer<idl::GoalFailed> cancel_;
  PushServer<idl::MotionCommand> motion_;
  PushServer<idl::Arrived> arrived_;
  PushServer<idl::GoalFailed> failed_;
  PushServer<idl::GoalPoint> goal_push_;
  PushServer<idl::Door> door_;
  PushServer<idl::Path> path_;
  QueryServer<idl::Ask, idl::Progress> progress_;
  PushProxy<idl::Odometry> odometry_;
  PushProxy<idl::RobotPose> localizer_;

  Param<double> blocked_after_;
  Param<double> lost_wait_;
  Param<double> height_;
  Param<double> door_run_up_;
  Param<double> door_room_;
  Param<double> weight_;

  SenderWatch senders_{host()};
  OdometryTrust trust_;
  SenderLife odometer_;
  bool lost_ = false;       // It is not known where the robot is.
  bool was_known_ = false;  // It was, at least once.
  std::optional<TimePoint> lost_at_;
  Route route_;
  HeldTime held_;
  PathShown path_shown_;
  Legs legs_;
  Patience patience_;
  Before before_;
  std::optional<TimePoint> posed_at_;
  Vec2 seen_at_;            // the robot, when its pose was taken last
  double stuck_ = 0.0;      // [s] without progress
  double deviation_ = 0.0;  // [m] standard deviation of its position, in the worst direction; 0: not known
  bool doubts_ = false;     // Whether it has said that it may be at the goal.
};

}  // namespace orca::go
