// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/sim/figures.hpp"

namespace orca::sim {

// Sensors are mounted in the frame B that the robot's file describes. On most robots that is the robot's
// frame R. On a synchro base R turns with the wheels, but the body does not; a turret turns too. X_RB is the
// pose in R of the frame B of the body or of the turret, whichever carries the sensor.

/// A reading of one sonar transducer.
struct SonarReading {
  std::size_t transducer = 0;  ///< Its number in the ring.
  TimePoint stamp;             ///< Time at which it fired.
  Pose2 sensor;                ///< Pose of the transducer when it fired, in the robot's frame.
  double range = 0.0;          ///< [m] Between the ring's min_range and max_range.
  bool echo = false;           ///< False: nothing came back, `range` is max_range.
};

/// One round of a ring, ordered by transducer number.
struct SonarScan {
  std::vector<SonarReading> readings;
  TimePoint stamp{};  ///< Time of the first shot.
  Pose2 X_RB{};       ///< Pose of frame B in R at the stamp, see above.
};

/// One sweep of a laser.
struct LaserScan {
  TimePoint stamp;             ///< Time of the first range; the last came the scanner's `sweep` later.
  std::vector<double> ranges;  ///< [m] One range per beam; max_range of the scanner if nothing came back.
  Pose2 X_RB;                  ///< Pose of frame B in R at the stamp, see above.
};

/// The readings of all sensors of an infrared ring, measured at once.
struct InfraredScan {
  TimePoint stamp;
  std::vector<double> ranges;  ///< [m] One range per sensor; max_range of the ring if nothing is near.
  Pose2 X_RB;                  ///< Pose of frame B in R at the stamp, see above.
};

/// A picture of a camera, as runs of one colour down its columns.
struct CameraShot {
  struct Run {
    std::uint32_t end = 0;           ///< Row at which it ends.
    std::optional<Colour> colour{};  ///< Nothing: the background, floor and ceiling.
  };
  TimePoint stamp{};
  std::vector<Run> runs{};  ///< From the upper row of each column to its lower one, column by column.
  std::vector<std::size_t> starts{};  ///< Number of the first run of each column.
  Pose2 X_RB{};                       ///< Pose of frame B in R at the stamp, see above.
};

/// The segments of a bumper that were pressed since its last reading.
struct BumperReading {
  TimePoint stamp;
  std::vector<bool> pressed;  ///< One value per segment.
  Pose2 X_RB;                 ///< Pose of frame B in R at the stamp, see above.
};

/// The pose computed from the wheel encoders. It is zero where the robot was added to the world.
struct OdometryReading {
  TimePoint stamp;
  Pose2 pose;  ///< Pose in the odometry frame.
  Twist2 velocity;
};

/// The direction of a turret.
struct TurretReading {
  TimePoint stamp;
  double angle = 0.0;      ///< [rad] Angle in the robot's frame, in (-pi, pi].
  double turn_rate = 0.0;  ///< [rad/s] Turn rate relative to the robot's frame.
};

/// The state of a gripper.
struct GripperReading {
  TimePoint stamp;
  /// Share of the gap between the open paddles, 0 (closed) to 1 (open). Paddles that hold an item stop at its width.
  double opening = 1.0;
  bool is_open = false;       ///< The paddles are open as far as they go.
  bool is_closed = false;     ///< The paddles meet; false if they have stopped at an item.
  bool paddles_move = false;  ///< The paddles are on their way to one of their ends.
  double lift = 0.0;          ///< Share of the lift's way, 0 (down) to 1 (up).
  bool lift_moves = false;    ///< The lift is on its way to one of its ends.
  /// An item interrupts the beam from paddle to paddle at a quarter of their depth from the root.
  bool inner_beam = false;
  bool outer_beam = false;  ///< The same at three quarters of the depth.
  bool holds = false;       ///< The paddles hold an item.
};

/// The state of a battery.
struct BatteryReading {
  TimePoint stamp;
  double charge = 1.0;    ///< Share of a full charge, 0 to 1.
  double voltage = 0.0;   ///< [V]
  bool charging = false;  ///< The robot rests at a charger.
};

/// The beginning of a touch between a robot and something else.
struct ContactEvent {
  std::string robot;
  TimePoint time;
  std::string other;                     ///< Name of the obstacle or of the other robot.
  double speed = 0.0;                    ///< [m/s] The robot's speed just before.
  std::optional<double> person_speed{};  ///< [m/s] That of the other, if it is a person.
};

/// A person who walks about, at one moment.
struct Person {
  std::string name;
  Vec2 position;
  double radius = 0.0;  ///< [m]
  double speed = 0.0;   ///< [m/s] At which it sets off; 0 while it rests or stands.
};

/// What the paddles of a gripper are told: `stay` leaves them to their former order, `halt` stops them where they are.
enum class Paddles { stay, open, close, halt };

/// What the lift of a gripper is told; `stay` and `halt` as above.
enum class Lift { stay, up, down, halt };

/// A command to a gripper. A plain value.
struct GripperOrder {
  Paddles paddles = Paddles::stay;
  Lift lift = Lift::stay;
};

}  // namespace orca::sim
