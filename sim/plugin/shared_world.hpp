// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "encounters.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/hw/endpoints.hpp"
#include "orca/hw/scene.hpp"
#include "orca/sim/world.hpp"

namespace orca::sim {

/// Time between two readings of the true pose.
inline constexpr Duration kTruthPeriod = std::chrono::milliseconds(100);

/// The world that the simulated robots of one run share, tied to the run's clock.
///
/// Whichever of them comes first at a tick advances it. The events of each robot wait in its Inbox until it
/// polls. So the order in which the robots' strands run at one time changes neither what a robot senses nor
/// when its commands take effect.
///
/// Thread contract: any strand; synchronised.
class SharedWorld {
 public:
  /// The readings and contacts of one robot since it last polled.
  struct Inbox {
    struct Truth {
      TimePoint stamp;
      Pose2 pose;
      Twist2 velocity;
    };
    /// The readings, each with the number of its device among those of its kind.
    template <class Reading>
    using Readings = std::vector<std::pair<std::size_t, Reading>>;
    Readings<SonarScan> sonar;
    Readings<LaserScan> laser;
    Readings<InfraredScan> infrared;
    Readings<BumperReading> bumper;
    Readings<CameraShot> camera;
    std::vector<OdometryReading> odometry;
    std::vector<TurretReading> turret;
    std::vector<GripperReading> gripper;
    std::vector<BatteryReading> battery;
    std::vector<Truth> truth;
    struct Contact {
      ContactEvent event;
      Pose2 robot;  ///< Pose of the robot in the world at that time.
    };
    std::vector<Contact> contacts;
    std::vector<std::string> happened;  ///< In the world, in words; only the robot that came first is told.
    Duration lost{
        0};  ///< Time [s] that the world has left out, because nobody drove it on; the first robot gets it.
  };

  /// Returns the world of that key, made by `make` if nobody holds it yet. The key names the run and the
  /// world's file.
  ///
  /// @param settings  the other settings of the world in words, e.g. "realism harsh".
  /// @errors  failed_precondition if it was made with other settings.
  static Result<std::shared_ptr<SharedWorld>> join(const std::string& key, const std::string& settings,
                                                   TimePoint now, const std::function<World()>& make);

  SharedWorld(World world, std::string settings, TimePoint now)
      : world_(std::move(world)), settings_(std::move(settings)), epoch_(now - TimePoint{}) {}

  /// @param truth_period  time between two entries of Inbox::truth.
  /// @errors  as World::add_robot().
  Result<RobotId> add_robot(const std::string& name, const RobotModel& model, const Pose2& X_WB,
                            Duration truth_period);

  /// Sets the command that the robot follows from `now` [run's clock] on: the ticks until then come first.
  ///
  /// @errors  as World::set_velocity_command().
  Status command(RobotId robot, const hw::DriveSetpoint& setpoint, TimePoint now);
  /// Points the robot's turret from `now` [run's clock] on.
  /// @errors  as World::set_turret_command().
  Status point_turret(RobotId robot, double angle, TimePoint now);
  /// Gives the robot's gripper an order at `now` [run's clock].
  /// @errors  as World::set_gripper_command().
  Status move_gripper(RobotId robot, const GripperOrder& order, TimePoint now);

  /// Simulates up to `now` [run's clock] and returns what the robot has sensed since its last call, stamped by
  /// the run's clock.
  ///
  /// A world that has fallen far behind, because the process was stopped or the machine is too slow, does not
  /// catch up. Its clock stands still for that long, so that no robot continues with an old command.
  Inbox advance(RobotId robot, TimePoint now);

  /// Returns the time of the first tick that the robot has not seen yet [run's clock]. It may have passed
  /// already: another robot may have advanced the world.
  [[nodiscard]] TimePoint next_tick(RobotId robot) const;
  /// Something that has happened in the world.
  struct Event {
    TimePoint time;  ///< Of the run's clock.
    std::string text;
    std::optional<Vec2> place{};
  };
  static constexpr Duration kEventsKept = std::chrono::seconds(5);

  /// Simulates up to `now` [run's clock], and lets `act` look at the world, or change it.
  template <class Act>
  auto at(TimePoint now, const Act& act) {
    const std::lock_guard lock(mutex_);
    catch_up(now);
    return act(world_);
  }
  /// Returns what has happened in the last kEventsKept before the present tick, the oldest first.
  [[nodiscard]] std::vector<Event> events() const;
  /// Notes that somebody has changed the world at `now` [run's clock].
  void note(std::string text, TimePoint now);

  /// Keeps from now on where the robot goes, for snapshot().
  void keep_trajectory(RobotId robot);
  /// Keeps the robot's true motion from now on, ten steps a second, for motion().
  void keep_motion(RobotId robot);
  [[nodiscard]] std::vector<Scene::Step> motion(RobotId robot) const;
  /// Returns the robot's encounters with people while its motion was kept.
  [[nodiscard]] std::vector<Scene::Encounter> encounters(RobotId robot) const;
  /// Returns how many people walk about.
  [[nodiscard]] std::size_t people() const;
  [[nodiscard]] Snapshot snapshot() const;

 private:
  struct Member {
    RobotId robot;
    std::string name;
    Duration truth_period{0};
    TimePoint next_truth;
    TimePoint next_turret;
    TimePoint next_gripper;
    TimePoint next_battery;
    TimePoint seen;  // World's clock when it last polled.
    Inbox inbox;
    std::optional<TimePoint> next_step{};  // Only if its motion is kept.
    std::vector<Scene::Step> motion{};
    Encounters encounters{};
  };

  [[nodiscard]] Member& member(RobotId robot);
  [[nodiscard]] const Member& member(RobotId robot) const;
  void catch_up(TimePoint now);
  void step();
  void collect(Member& member);
  void collect_readings(Member& member);
  void collect_turret(Member& member);
  void collect_gripper(Member& member);
  void collect_battery(Member& member);
  void collect_motion(Member& member);
  void collect_encounters(Member& member);
  void collect_events();
  [[nodiscard]] TimePoint on_run_clock(TimePoint time) const { return time + epoch_; }

  mutable std::mutex mutex_;
  World world_;
  const std::string settings_;
  Duration epoch_;               // The run's clock when the world's clock was zero.
  std::vector<Member> members_;  // By RobotId.
  std::deque<Event> events_;     // The oldest first.
};

}  // namespace orca::sim
