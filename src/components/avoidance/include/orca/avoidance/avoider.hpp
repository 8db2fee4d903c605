// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orca/avoidance/advice.hpp"
#include "orca/avoidance/escape.hpp"
#include "orca/avoidance/seen_floor.hpp"
#include "orca/component.hpp"
#include "orca/component/sender_life.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/component/standing_watch.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/moving.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"

namespace orca::avoid {

/// The common part of all avoid behaviours (thesis 11.1). It has no opinion while the way is free; otherwise
/// it wishes for a free direction, slower the nearer the obstacle is. A derived class listens to its sensor and
/// chooses the direction.
///
/// With odometry it remembers echoes and gives advice as often as odometry comes. Without odometry it gives
/// advice as often as the sensor delivers, from those readings alone. With a goal it chooses the free
/// direction nearest to the direction of the goal. The pose comes from the localizer or, without one, from
/// the odometry.
///
/// A reading that says nothing valid counts as none: the robot stands until a valid one of that sender comes.
///
/// With odometry and a goal it also gets a robot free that has met something unseen, see Escape.
///
/// A base at its port `robot` is asked how large the robot is and how often its sensor measures. The answer is not
/// waited for, but until it comes the robot stands.
///
/// An avoid behaviour of any type that takes its place while the robot drives gets its knowledge, and need not look
/// around first.
///
/// Thread contract: as every component.
class Avoider : public Component {
 protected:
  /// The differences between behaviours with different sensors.
  struct Manner {
    double echo_time = 0.0;      ///< [s] The default: how long an echo counts that was heard once.
    double memory_time = 4.0;    ///< [s] The same for one that was heard at least twice.
    double standing_pace = 1.0;  ///< How fast echoes age while the robot stands; 1: as ever.
    double yields =
        1e-3;  ///< Weight of others' wishes where the robot must not drive on, relative to its own.
  };
  Avoider(ComponentHost& host, const Manner& manner);

  /// Returns the port of the sensor.
  [[nodiscard]] virtual PushProxyHandle& sensor() = 0;
  /// Returns the object type that the sensor delivers.
  [[nodiscard]] virtual const ObjectType& sensed() const = 0;
  /// Puts the newest readings of the sensor into the memory.
  /// @return whether they count: is_valid(), and measured lately.
  /// @pre  sensor() has new data.
  virtual bool listen(EchoMemory& memory) = 0;
  /// Does the same for sensors besides it, if the class has any. Called once a lap.
  virtual void listen_aside(EchoMemory& /*memory*/) {}
  /// Returns whether each of those has been heard in the last `longest` seconds.
  [[nodiscard]] virtual bool hears_aside(double /*longest*/) const { return true; }
  /// Says who of those is silent, for people.
  [[nodiscard]] virtual std::string silent_aside(double /*longest*/) const { return {}; }
  /// Returns whether something is so near to a sensor that it cannot be measured. The robot then stands.
  [[nodiscard]] virtual bool is_covered() { return false; }
  /// Says what of the last readings must hold the robot where it is, for people; empty if nothing does. Called while it stands.
  [[nodiscard]] virtual std::string what_holds() { return {}; }
  /// Returns what the robot should do. Called once a lap, unless the robot must stand anyway.
  /// @param limits  those of the parameters, with a side distance of 0.
  [[nodiscard]] virtual Advice advice(const EchoMemory& memory, const Situation& situation,
                                      const Limits& limits) = 0;

  // A derived class that overrides these calls them too.
  Status params_changed() override;
  Status configure() override;
  Status start() override;
  void stop() override;

  /// Returns whether it carries echoes along, because it hears of the robot's motion.
  [[nodiscard]] bool remembers() const { return odometry_.connected(); }

  /// Echoes are kept in the frame that the robot had at the stamp of its last odometry, which may have come over a slow line;
  /// without odometry, in the one that it has now. Returns the time [s] from `seen` until then; negative if it was seen later.
  [[nodiscard]] double age_of(TimePoint seen) const;
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
  /// Moves a point of that age [s] into the frame in which echoes are kept, using odometry.
  [[nodiscard]] Vec2 moved_since(Vec2 point, double age) const;
  /// Returns how far the robot has turned [rad] in the `age` [s] before that frame.
  [[nodiscard]] double turned_since(double age) const { return twist_.turn_rate * age; }
  [[nodiscard]] EchoMemory::Limits keep() const;
  /// Notes the floor that a scan shows, if it remembers.
  void note_floor(const Scan& scan) {
    if (moved_at_) floor_.note(scan, pose_ * scan.X_RS);
  }
  /// Returns the rectangle that holds the robot, if the base has described one.
  [[nodiscard]] std::optional<Rectangle> described_body() const;
  /// Returns the time [s] without readings after which the robot stops, which is also the largest age of a reading.
  [[nodiscard]] double deaf_after() const;
  /// Returns the radius [m] of the circle that holds the robot.
  [[nodiscard]] double radius() const { return body_ ? body_->radius : *robot_radius_; }
  /// Returns the outline of a robot with that body; without one, its circle.
  [[nodiscard]] nav::Footprint outline_of(const std::optional<Rectangle>& body) const;
  /// Returns the time [s] from an echo until the robot follows the advice.
  [[nodiscard]] double reaction_time() const { return *reaction_time_; }
  /// Returns the distance [m] from the robot's centre beyond which nothing changes any advice.
  [[nodiscard]] double farthest() const;

 private:
  static constexpr std::uint32_t kStateVersion = 5;

  // The robot's body, as the base reports it.
  struct Body {
    double radius;              // [m] of the circle that holds the body and the bumpers.
    double sensor_interval;     // [s] between two readings of the sensor; 0: not known.
    double length;              // [m] of the rectangle that holds the body; 0: the circle is all.
    double width;               // [m]
    bool slides = false;        // Whether it can move sideways.
    double acceleration = 0.0;  // [m/s2] at which it gains and loses speed; 0: not known.
  };

  Outcome work() override;
  void save_state(StateWriter& state) const override;
  Status load_state(StateReader& state) override;
  [[nodiscard]] std::uint32_t state_version() const override { return kStateVersion; }
  [[nodiscard]] std::vector<StateTag> accepted_states() const override;

  Status ask_robot();
  Status learn_robot();
  bool follow(const idl::Odometry& odometry);
  void advise();
  [[nodiscard]] std::optional<nav::Steer> escape(const Situation& situation);
  void feel_ahead();
  [[nodiscard]] Limits limits() const;
  [[nodiscard]] std::string why_deaf();
  /// Returns the goal that the robot drives to now; null if there is none, or if nobody has said so lately.
  [[nodiscard]] ObjectPtr<idl::GoalPoint> present_goal() const;
  /// Adds what is known of the goal, if there is one and the robot knows where it is itself.
  void add_goal(Situation& situation);
  [[nodiscard]] Situation situation();
  [[nodiscard]] std::optional<Pose2> pose();

  PushProxy<idl::Odometry> odometry_;
  PushProxy<idl::GoalPoint> goal_;
  PushProxy<idl::RobotPose> localizer_;
  PushServer<idl::MotionCommand> motion_;
  PushProxy<idl::MovingThings> moving_{*this,
                                       "moving",
                                       {.text = "Who moves near the robot: a PersonTracker. A robot that "
                                                "stands while somebody passes has met nothing.",
                                        .optional = true}};
  QueryProxy<idl::Ask, idl::Robot> robot_{
      *this,
      "robot",
      {.text = "Base that is asked how large the robot is and how often the sensor measures.",
       .optional = true}};

  const Manner manner_;
  Param<double> robot_radius_;
  Param<double> margin_;
  Param<double> safe_distance_;
  Param<double> stop_distance_;
  Param<bool> sideways_;
  Param<double> max_speed_;
  Param<double> weight_;
  Param<double> reaction_time_;
  Param<double> memory_time_;
  Param<double> echo_time_;
  Param<double> same_place_;
  Param<double> memory_range_;
  Param<double> deaf_after_;
  Param<double> goal_max_age_;

  SenderWatch senders_{host()};
  SenderLife odometer_;
  std::optional<QueryId> question_;  // To the base, as long as it has not answered.
  std::optional<Body> body_;
  EchoMemory memory_;
  Pose2 pose_;  // In the frame of the odometry.
  Twist2 twist_;
  std::optional<TimePoint> moved_at_;
  std::optional<TimePoint> heard_at_;
  double last_direction_ = 0.0;
  StandingWatch standing_{host()};
  std::optional<Escape> escape_;
  SeenFloor floor_;  // In the frame of the odometry.
};

}  // namespace orca::avoid
