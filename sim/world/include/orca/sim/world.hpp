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

/// The number of a robot in one World; comes from add_robot.
enum class RobotId : std::size_t {};

/// The number of an obstacle that was added to one World while it ran; comes from add_obstacle.
enum class ObstacleId : std::size_t {};

/// Something that stands in a running world and is not of its plan: an obstacle that was added, or an item. A plain value.
struct Standing {
  std::string name;
  Shape shape;                     ///< Its plan, in its own frame.
  Pose2 X_WO;                      ///< Where it is now.
  std::optional<ObstacleId> id{};  ///< Nothing: it is an item.
};

/// A door of a running world. A plain value.
struct DoorState {
  std::string name;
  Segment
      leaf;  ///< Where it is now, in the world frame: from its hinges, or from where it slides to, to its free edge.
  bool opens = false;  ///< Whether it is open, or on its way to be.
};

/// A running simulation: a world, the robots in it, and a time that only step() advances.
///
/// Two worlds that are built and used in the same way with the same options are bit-identical at each tick. A
/// World cannot be reset: build a new one for each run. It drives, measures and reports contacts, but does
/// not steer. A command holds until the next one (a watchdog belongs to the driver).
///
/// Thread contract: not synchronised; one strand.
class World {
 public:
  struct Options {
    std::uint64_t seed = 1;
    Realism realism = Realism::nominal;
    std::optional<ErrorLevels> errors{};  ///< If given, they count instead of those of `realism`.
    /// Number of threads that compute sensor readings; 0: one per processor. Results do not depend on it.
    unsigned threads = 1;
  };
  static constexpr Duration kTick = std::chrono::milliseconds{10};

  World(WorldModel model, Options options);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Adds a robot at rest, with its wheels and turret pointing ahead. Its sensors and odometry start now.
  ///
  /// @param name  not empty; the robot's random streams are keyed by it.
  /// @param X_WB  pose of its base frame in the world.
  /// @errors  already_exists: the name is taken. invalid_argument: the name is empty or the pose not finite.
  ///          failed_precondition: something stands there already; the text says what.
  [[nodiscard]] Result<RobotId> add_robot(const std::string& name, const RobotModel& model,
                                          const Pose2& X_WB);

  /// Returns the robot of that name, if there is one.
  [[nodiscard]] std::optional<RobotId> find(std::string_view name) const;

  /// Adds an obstacle that stands on the floor. Sensors see it and robots touch it from the next tick on.
  ///
  /// @param name    name that contacts report; not empty, not that of another such obstacle, an item or a walker.
  /// @param shape   plan, in the obstacle's own frame.
  /// @param height  [m] height of its top above the floor.
  /// @param X_WO    pose of that frame in the world.
  /// @errors  already_exists: the name is taken. invalid_argument: no name, no area, no height, or a pose
  ///          that is not finite. failed_precondition: a robot is there; the text says which.
  [[nodiscard]] Result<ObstacleId> add_obstacle(const std::string& name, const Shape& shape, double height,
                                                const Pose2& X_WO);

  /// Moves such an obstacle at once; it pushes nothing on the way.
  /// @errors  not_found: it was removed. Otherwise as add_obstacle().
  Status move_obstacle(ObstacleId obstacle, const Pose2& X_WO);

  /// Removes such an obstacle. @errors  not_found: it was removed already.
  Status remove_obstacle(ObstacleId obstacle);

  /// Puts a robot elsewhere at once, at rest. Its odometry does not notice; its command stays. What it holds goes along.
  /// @errors  invalid_argument: the pose is not finite. failed_precondition: something stands there; the text says what.
  Status place_robot(RobotId robot, const Pose2& X_WB);

  /// Sets the velocity that the base drives from now on; the drive's limits, lag and dead time apply.
  ///
  /// @param forward [m/s]  along the robot's x axis.
  /// @param turn_rate [rad/s]  counter-clockwise.
  /// @errors  invalid_argument if a number is not finite or beyond 1000; the former command stays.
  Status set_velocity_command(RobotId robot, double forward, double turn_rate);

  /// Sets a velocity that may have a sideways part; otherwise as above.
  /// @errors  also failed_precondition for a sideways part if the base is not holonomic; the former command
  ///          stays.
  Status set_velocity_command(RobotId robot, const Twist2& wanted);

  /// Stops the base as hard as it can, in the place of a velocity: with the robot's stop_deceleration, without lag,
  /// after the dead time. A robot that has none stops as on a velocity of 0.
  void emergency_stop(RobotId robot);

  /// Sets the direction in which the turret points from now on. Within its limits it turns there by the
  /// shorter way and keeps the angle in the robot's frame while the robot turns. At first it points ahead.
  ///
  /// @param angle [rad]  in the robot's frame, counter-clockwise.
  /// @errors  failed_precondition if the robot has no turret, invalid_argument if the angle is not finite.
  Status set_turret_command(RobotId robot, double angle);

  /// Orders the gripper from now on. Each part of the order that is not `stay` replaces the former order of that part.
  ///
  /// Paddles that close with the lift in the lower half of its way hold an item whose centre is between them, as soon as the
  /// gap is as narrow as the item. Of several they hold the widest, of equal ones the nearest to their root; one that is wider
  /// than the gap does not stop them. A held item goes along, and nothing sees or touches it. Paddles that open put it on the
  /// floor where it is, or drop it there from a raised lift. If something is there, they stay closed. happened() tells all of
  /// this.
  /// @errors  failed_precondition if the robot has no gripper.
  Status set_gripper_command(RobotId robot, const GripperOrder& order);

  /// Advances the time by exactly one tick.
  void step();

  /// Returns the time since the world was made: ticks times kTick.
  [[nodiscard]] TimePoint time() const;

  /// Returns the true pose of the robot's frame in the world. Its x axis points forward, on a synchro base in
  /// the direction of the wheels.
  [[nodiscard]] Pose2 pose(RobotId robot) const;
  /// Returns the true pose of the body. It equals pose() except on a synchro base, whose body does not turn
  /// with its wheels.
  [[nodiscard]] Pose2 body_pose(RobotId robot) const;
  /// Returns the present angle of the turret; nothing if the robot has none.
  [[nodiscard]] std::optional<TurretReading> turret(RobotId robot) const;
  /// Returns the present state of the gripper; nothing if the robot has none.
  [[nodiscard]] std::optional<GripperReading> gripper(RobotId robot) const;
  /// Returns where the model's item of that name is in the world, also while a gripper holds it; nothing if there is none.
  [[nodiscard]] std::optional<Pose2> item_pose(std::string_view name) const;
  /// Returns the true velocity in the last tick, in the robot's frame.
  [[nodiscard]] Twist2 velocity(RobotId robot) const;

  /// Returns how far the robot is from the nearest thing that it could touch [m], at most `limit`; 0 or less while it touches.
  [[nodiscard]] double clearance(RobotId robot, double limit) const;

  /// Returns the contacts that began in the last tick. A touch is reported once, until the two have come
  /// apart again. If two robots collide, both report it.
  [[nodiscard]] const std::vector<ContactEvent>& contacts() const;

  /// Returns what happened in the last tick, in words: the model's events, and what grippers have taken or let go.
  [[nodiscard]] const std::vector<std::string>& happened() const;

  /// Returns the round that the robot's sonar ring number `ring` completed in the last tick, if it did.
  [[nodiscard]] const std::optional<SonarScan>& sonar(RobotId robot, std::size_t ring = 0) const;

  /// Returns the scan that the robot's laser number `laser` completed in the last tick, if it did.
  [[nodiscard]] const std::optional<LaserScan>& laser(RobotId robot, std::size_t laser = 0) const;

  /// Returns the round that the robot's infrared ring number `ring` measured in the last tick, if it did.
  [[nodiscard]] const std::optional<InfraredScan>& infrared(RobotId robot, std::size_t ring = 0) const;

  /// Returns the reading of the robot's bumper number `ring`, if one became due in the last tick.
  [[nodiscard]] const std::optional<BumperReading>& bumper(RobotId robot, std::size_t ring = 0) const;

  /// Returns the odometry, if it became due in the last tick; never anything for a robot without odometer.
  [[nodiscard]] const std::optional<OdometryReading>& odometry(RobotId robot) const;

  [[nodiscard]] const WorldModel& model() const;
  [[nodiscard]] const RobotModel& robot_model(RobotId robot) const;
  /// Returns the caster, for further sensors: it sees the robots, walkers and obstacles at their present
  /// places.
  [[nodiscard]] const Caster& caster() const;
  /// Returns the robot's number among the caster's bodies.
  [[nodiscard]] std::size_t body(RobotId robot) const;
  /// Keeps from now on where the robot goes, for snapshot(). It takes up to 512 KiB.
  void keep_trajectory(RobotId robot);
  /// Returns a picture of the world, with the trajectories that are kept.
  [[nodiscard]] Snapshot snapshot() const;

  /// Returns an FNV-1a hash over the bits of time, poses, velocities, odometry, grippers and items: equal for equal runs.
  [[nodiscard]] std::uint64_t state_hash() const;

  friend std::vector<Person> people_in(const World& world);
  friend std::vector<std::string> robots_in(const World& world);
  friend std::vector<Standing> standing_in(const World& world);
  friend std::vector<DoorState> doors_in(const World& world);
  friend Status turn_door(World& world, std::string_view name, bool opens);
  friend const std::optional<CameraShot>& picture_in(const World& world, RobotId robot, std::size_t camera);
  friend std::optional<BatteryReading> battery_in(const World& world, RobotId robot);
  friend Status set_charge(World& world, RobotId robot, double charge);
  friend Status set_silent(World& world, const Outage& which, bool silent);
  friend std::vector<std::string> silent_in(const World& world, RobotId robot);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Returns the people who walk about in a world, as they are now.
[[nodiscard]] std::vector<Person> people_in(const World& world);

/// Returns the names of the robots in a world, in the order in which they came.
[[nodiscard]] std::vector<std::string> robots_in(const World& world);

/// Returns what stands in a world and may go again, also while a gripper holds it; leaves of doors have the doors' names. The events of the model count as whoever
/// calls add_obstacle().
[[nodiscard]] std::vector<Standing> standing_in(const World& world);

/// Returns the doors of a world, in the order of its model.
[[nodiscard]] std::vector<DoorState> doors_in(const World& world);

/// Opens or shuts a door from now on, as an event of the model does: the leaf stops at a robot in its way, and goes on when that has
/// gone. What is opened so stays open, also if the door has a closer.
/// @errors  not_found: there is no such door. failed_precondition: it is so already, or a person holds it open.
Status turn_door(World& world, std::string_view name, bool opens);

/// Silences all sensors of a kind of a robot, or one of them, from now on, or ends that, whoever has silenced them.
/// @param which  its times are not read.
/// @errors  not_found: there is no such robot or sensor. failed_precondition: it is so already; or one is to work again where all
///          were silenced together.
Status set_silent(World& world, const Outage& which, bool silent);

/// Returns what is silent of a robot: "laser", or "laser rear" for one of several.
[[nodiscard]] std::vector<std::string> silent_in(const World& world, RobotId robot);

/// Returns the picture that the robot's camera number `camera` took in the last tick, if it did.
[[nodiscard]] const std::optional<CameraShot>& picture_in(const World& world, RobotId robot,
                                                          std::size_t camera = 0);

/// Returns the present state of a robot's battery; nothing if it has none. An empty one drives the base no more.
[[nodiscard]] std::optional<BatteryReading> battery_in(const World& world, RobotId robot);
/// Gives a robot's battery another charge. @param charge  share of a full one, 0 to 1. @errors  not_found: it has none.
Status set_charge(World& world, RobotId robot, double charge);

}  // namespace orca::sim
