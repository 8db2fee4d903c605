// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "orca/avoidance/advice.hpp"
#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"

namespace orca::avoid {

/// What all avoid behaviours share (thesis 11.1): no opinion while the way is free, else a direction that is
/// free, slower the nearer the obstacle. What is heard comes from a behaviour of its own sensor.
///
/// With odometry it remembers what it heard and gives advice as often as odometry comes; without, as often as
/// the sensor speaks and from that alone. With a goal it chooses among free directions the one nearest to the
/// goal's, with the pose from the localizer or, without one, from the odometry.
///
/// Thread contract: as every component.
class Avoider : public Component {
 protected:
  /// @param echo_time  [s] the sensor's default for how long what it heard only once counts.
  Avoider(ComponentHost& host, double echo_time);

  /// The port of the sensor.
  [[nodiscard]] virtual PushProxyHandle& sensor() = 0;
  /// Puts what the sensor has new into the memory.
  /// @pre  sensor() has new data.
  virtual void listen(EchoMemory& memory) = 0;

  /// Where what was `age` [s] ago in a place of the robot frame is now, as the robot has moved since.
  [[nodiscard]] Echo moved_since(const Echo& echo, double age) const;
  /// How far it has turned in the last `age` [s] [rad].
  [[nodiscard]] double turned_since(double age) const { return turn_rate_ * age; }
  [[nodiscard]] EchoMemory::Limits keep() const;
  /// [m] from the robot's centre: what is farther away does not change any advice.
  [[nodiscard]] double farthest() const;

 private:
  Status configure() override;
  Status params_changed() override;
  Status start() override;
  Outcome work() override;

  void follow(const idl::Odometry& odometry);
  void advise();
  [[nodiscard]] Limits limits() const;
  [[nodiscard]] std::optional<double> goal_direction() const;
  [[nodiscard]] std::optional<Motion> pose() const;

  PushProxy<idl::Odometry> odometry_;
  PushProxy<idl::GoalPoint> goal_;
  PushProxy<idl::RobotPose> localizer_;
  PushServer<idl::MotionCommand> motion_;

  Param<double> robot_radius_;
  Param<double> margin_;
  Param<double> side_distance_;
  Param<double> safe_distance_;
  Param<double> stop_distance_;
  Param<double> max_speed_;
  Param<double> weight_;
  Param<double> reaction_time_;
  Param<double> memory_time_;
  Param<double> echo_time_;
  Param<double> same_place_;
  Param<double> memory_range_;
  Param<double> deaf_after_;
  Param<double> goal_max_age_;

  EchoMemory memory_;
  Motion pose_;
  double speed_ = 0.0;
  double turn_rate_ = 0.0;
  std::optional<TimePoint> moved_at_;
  std::optional<TimePoint> heard_at_;
  double last_direction_ = 0.0;
};

}  // namespace orca::avoid
