// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/sim/caster.hpp"
#include "orca/sim/readings.hpp"
#include "orca/sim/realism.hpp"
#include "orca/sim/robot_model.hpp"
#include "orca/sim/snapshot.hpp"
#include "orca/sim/world_model.hpp"

namespace orca::sim {

/// Names a robot of one World; comes from add_robot.
enum class RobotId : std::size_t {};

/// Names an obstacle that was put into one World while it ran; comes from add_obstacle.
enum class ObstacleId : std::size_t {};

/// A running simulation: a world, robots in it, and time that advances by step() and by nothing else.
///
/// Two worlds that are built and used alike with the same options are bit-identical at each tick. A World
/// cannot be reset: build a new one for each run. It drives, measures and reports contacts; it does not
/// steer, and a command holds until the next one (a watchdog belongs to the driver).
///
/// Thread contract: not synchronised; one strand.
class World {
 public:
  struct Options {
    std::uint64_t seed = 1;
    Realism realism = Realism::nominal;
    unsigned threads =
        1;  ///< That compute sensor readings; 0: one per processor. Results do not depend on it.
  };
  static constexpr Duration kTick = std::chrono::milliseconds{10};

  World(WorldModel model, Options options);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Sets a robot down, at rest, its wheels and turret ahead. Its sensors and odometry start now.
  ///
  /// @param name  not empty; the robot's random streams are keyed by it.
  /// @param X_WB  pose of its base frame in the world.
  /// @errors  already_exists: the name is taken. invalid_argument: the name is empty or the pose not finite.
  ///          failed_precondition: something stands there already, and what.
  [[nodiscard]] Result<RobotId> add_robot(const std::string& name, const RobotModel& model,
                                          const Pose2& X_WB);

  /// The robot of that name, if there is one.
  [[nodiscard]] std::optional<RobotId> find(std::string_view name) const;

  /// Puts an obstacle in. Sensors see it and robots touch it from the next tick on.
  ///
  /// @param name    as contacts tell it; not empty, no other such obstacle's and no walker's.
  /// @param shape   in a frame of its own.
  /// @param height  [m] how tall it stands on the floor.
  /// @param X_WO    where that frame is in the world.
  /// @errors  already_exists: the name is taken. invalid_argument: no name, no area, no height, or a pose
  /// that is
  ///          not finite. failed_precondition: a robot is there, and which.
  [[nodiscard]] Result<ObstacleId> add_obstacle(const std::string& name, const Shape& shape, double height,
                                                const Pose2& X_WO);

  /// Takes such an obstacle elsewhere, at once: it pushes nothing on the way.
  /// @errors  not_found: it was taken out. Else as add_obstacle().
  Status move_obstacle(ObstacleId obstacle, const Pose2& X_WO);

  /// @errors  not_found: it was taken out already.
  Status remove_obstacle(ObstacleId obstacle);

  /// What the base shall do from now on; the drive's limits, lag and dead time apply.
  ///
  /// @param forward [m/s]  along the robot's x axis.
  /// @param turn_rate [rad/s]  counter-clockwise.
  /// @errors  invalid_argument if a number is not finite; the former command stays.
  Status set_velocity_command(RobotId robot, double forward, double turn_rate);

  /// The same, with a sideways part.
  /// @errors  also failed_precondition for a sideways part if the base is not holonomic; the former command
  ///          stays.
  Status set_velocity_command(RobotId robot, const Twist2& wanted);

  /// Where the turret shall point from now on; within its limits it goes there by the shorter way and keeps
  /// to it while the robot turns. At first it points ahead.
  ///
  /// @param angle [rad]  in the robot's frame, counter-clockwise.
  /// @errors  failed_precondition if the robot has no turret, invalid_argument if the angle is not finite.
  Status set_turret_command(RobotId robot, double angle);

  /// Advances the time by exactly one tick.
  void step();

  /// Time since the world was made: ticks times kTick.
  [[nodiscard]] TimePoint time() const;

  /// True pose of the robot's frame in the world: x is forward, on a synchro base the way the wheels point.
  [[nodiscard]] Pose2 pose(RobotId robot) const;
  /// True pose of the body: pose() but on a synchro base, whose body does not turn with its wheels.
  [[nodiscard]] Pose2 body_pose(RobotId robot) const;
  /// Where the turret points now; nothing without turret.
  [[nodiscard]] std::optional<TurretReading> turret(RobotId robot) const;
  /// True velocity in the last tick, in the robot's frame.
  [[nodiscard]] Twist2 velocity(RobotId robot) const;

  /// Contacts that began in the last tick: one for each touch, until the two have come apart again. If two
  /// robots collide both report it.
  [[nodiscard]] const std::vector<ContactEvent>& contacts() const;

  /// The round that the robot's sonar ring number `ring` completed in the last tick, if it did.
  [[nodiscard]] const std::optional<SonarScan>& sonar(RobotId robot, std::size_t ring = 0) const;

  /// The scan that the robot's laser number `laser` completed in the last tick, if it did.
  [[nodiscard]] const std::optional<LaserScan>& laser(RobotId robot, std::size_t laser = 0) const;

  /// The round that the robot's infrared ring number `ring` measured in the last tick, if it did.
  [[nodiscard]] const std::optional<InfraredScan>& infrared(RobotId robot, std::size_t ring = 0) const;

  /// What the robot's bumper number `ring` tells, if a reading became due in the last tick.
  [[nodiscard]] const std::optional<BumperReading>& bumper(RobotId robot, std::size_t ring = 0) const;

  /// The odometry if it became due in the last tick. Never for a robot without odometer.
  [[nodiscard]] const std::optional<OdometryReading>& odometry(RobotId robot) const;

  [[nodiscard]] const WorldModel& model() const;
  [[nodiscard]] const RobotModel& robot_model(RobotId robot) const;
  /// For further sensors: casts see the robots, walkers and obstacles where they are now.
  [[nodiscard]] const Caster& caster() const;
  /// The robot's number among the caster's bodies.
  [[nodiscard]] std::size_t body(RobotId robot) const;
  /// What to draw, with the way each robot has come.
  [[nodiscard]] Snapshot snapshot() const;

  /// FNV-1a over time, poses, velocities and odometry, bit by bit: equal for equal runs.
  [[nodiscard]] std::uint64_t state_hash() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace orca::sim
