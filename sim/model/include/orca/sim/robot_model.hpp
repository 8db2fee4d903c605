// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/usual_figures.hpp"
#include "orca/sim/mesh.hpp"
#include "orca/sim/sensors.hpp"

namespace orca::sim {

/// A pose in space: position [m] and unit quaternion. It gives a part's pose in the robot's base frame B (x
/// forward, y left, z up, origin on the floor between the wheels). On a synchro base B is the body's frame.
/// It equals the robot's frame R (x in the direction of the wheels) as long as the wheels point ahead.
struct Pose3 {
  double x = 0.0, y = 0.0, z = 0.0;
  double qx = 0.0, qy = 0.0, qz = 0.0, qw = 1.0;
};

/// One solid of the robot. All forms but a hull are centred at the part's own frame.
struct Part {
  struct Block {
    double x, y, z;  ///< Full lengths [m].
  };
  struct Cylinder {
    double radius;  ///< [m]
    double length;  ///< [m] Length along z.
  };
  struct Ball {
    double radius;  ///< [m]
  };
  struct Hull {
    std::vector<Vec3> corners;  ///< [m] Corners of a convex body, in the part's frame.
  };
  std::variant<Block, Cylinder, Ball, Hull> form;
  Pose3 X_BP;
};

/// The kinematics of a base; docs/simulation.md has the models.
enum class DriveKind {
  differential,  ///< Two wheels on one axle.
  synchro,       ///< Three wheels, steered and driven together; the body does not turn with them.
  holonomic,     ///< Three omnidirectional wheels, 120 degrees apart.
};

/// The drive of a base. Speeds and accelerations are limits, > 0; those of a holonomic base hold in every
/// direction.
struct Drive {
  DriveKind kind = DriveKind::differential;
  double max_speed = 0.0;              ///< [m/s]
  double max_turn_rate = 0.0;          ///< [rad/s]
  double max_acceleration = 0.0;       ///< [m/s2]
  double max_turn_acceleration = 0.0;  ///< [rad/s2]
  double stop_deceleration = 0.0;      ///< [m/s2] Of an emergency stop; 0: it stops like on any command.
  double track = 0.0;                  ///< [m] Diameter of the circle through the wheels' contact points.
  double wheel_diameter = 0.0;         ///< [m]
  Duration lag{0};                     ///< Time constant of the first-order answer to a command.
  Duration dead_time{0};               ///< Time from a command to its first effect.
  // Parameters for steering the base (thesis 8.4.1); the simulation itself does not use these.
  double steer_gain = kUsualSteerGain;             ///< [1/s] Turn rate per heading error.
  double speed_step = 0.0;                         ///< [m/s] Smallest change of speed worth a command.
  double big_turn_angle = 0.5 * std::numbers::pi;  ///< [rad] The base slows down for larger heading errors.
  double big_turn_speed = 0.0;                     ///< [m/s] Largest speed in such a turn.
  DeviceLabel label{};
};

/// A turret on top of the base, with its own upright axis and sensors. It turns without end. Its collision
/// geometry is round, so that turning moves only sensors.
struct Turret {
  std::string joint;              ///< The URDF joint that turns.
  double max_speed = 0.0;         ///< [rad/s]
  double max_acceleration = 0.0;  ///< [rad/s2]
  Duration period{0};             ///< Time from one reading of its angle to the next.
  Vec2 axis;                      ///< [m] Place of its axis in the base frame.
  DeviceLabel label{};
};

/// A gripper of two paddles that a lift raises. It carries the world's items (world_model.hpp).
///
/// The paddles themselves are not solid in the simulation: nothing touches or sees them. Only the item that they hold, or that
/// their beams see, matters.
struct Gripper {
  std::string link;         ///< The URDF link at the root of the paddles.
  Pose2 mount;              ///< Pose of that link in the base frame; its x axis points out of the gripper.
  double opening = 0.0;     ///< [m] Gap between the open paddles, > 0.
  double depth = 0.0;       ///< [m] Length of the paddles, along x from the root, > 0.
  double lift = 0.0;        ///< [m] How high the lift raises them, > 0.
  Duration paddle_time{0};  ///< Time from open to closed, the same back, > 0.
  Duration lift_time{0};    ///< Time from down to up, the same back, > 0.
  Duration period{0};       ///< Time from one reading of its state to the next.
  DeviceLabel label{};
};

/// A ring of sonar transducers. Number k looks along first_angle + k * pitch from the ring's centre and sits
/// `radius` from it in that direction. An uneven ring lists the directions of all, and may list their places.
struct SonarRing {
  std::string name;
  std::size_t count = 0;
  /// [rad] Direction of transducer 0 in the base frame, counter-clockwise from ahead.
  double first_angle = 0.0;
  double pitch = 0.0;           ///< [rad] Angle from one transducer to the next, counter-clockwise positive.
  std::vector<double> angles;   ///< [rad] Direction of each transducer; empty: evenly spaced as above.
  std::vector<Vec2> positions;  ///< [m] Place of each transducer about the centre; empty: on the circle.
  std::vector<double> heights;  ///< [m] Height of each transducer above the link; empty: all 0.
  double half_lobe = 0.0;       ///< [rad] Half the opening of the cone.
  double min_range = 0.0;       ///< [m] Nearer echoes read as this.
  double max_range = 0.0;       ///< [m] The reading if there is no echo.
  double quantum = 0.0;         ///< [m] Step of the device's readings; 0: none.
  double offset = 0.0;          ///< [m] What a driver adds to the scaled raw value; readings include it.
  double radius = 0.0;          ///< [m] Distance of the transducers from the centre.
  Duration period{0};           ///< Time in which all of them fire, one after the other.
  std::string link;             ///< The URDF link at the ring's centre.
  Pose2 center;                 ///< Pose of that link in the base frame.
  double height = 0.0;          ///< [m] Height of that link above the floor.
  bool on_turret = false;       ///< Whether that link turns with the turret.
  std::vector<std::size_t> order;  ///< Firing order, a permutation of 0 .. count - 1.
  std::size_t parallel = 1;        ///< Number of successive transducers in `order` that fire at once.
  DeviceLabel label{};
  Guesses<RangeErrorGuess> errors{};

  /// Returns the pose of transducer `k` in the base frame; it looks along its x axis.
  [[nodiscard]] Pose2 transducer(std::size_t k) const;
  /// Returns the height of transducer `k` above the floor [m].
  [[nodiscard]] double height_of(std::size_t k) const {
    return heights.empty() ? height : height + heights[k];
  }
};

/// The device that counts wheel travel.
struct Odometer {
  Duration period{0};  ///< Time from one reading to the next.
  DeviceLabel label{};
  Guesses<WheelErrorGuess> errors{};
};

/// The description of a type of robot for the simulation, or of sensors without a robot. A plain value; see read_robot().
struct RobotModel {
  std::string name;  ///< Name of the URDF's <robot>.
  std::string vendor;
  std::string model;
  double radius = 0.0;         ///< [m] Radius of the body.
  double bumper_radius = 0.0;  ///< [m] Radius of the parts that touch first.
  double mass = 0.0;           ///< [kg] Mass of all links.
  double yaw_inertia = 0.0;    ///< [kg m2] Moment of inertia about the base frame's z axis.
  std::vector<Part> parts;     ///< Collision geometry; never empty.
  Shape footprint;             ///< The parts' plan in the base frame: a circle or a convex outline.
  double bottom = 0.0;         ///< [m] Lowest point of the parts.
  double top = 0.0;            ///< [m] Highest point of the parts.
  /// Whether it has no drive: it stays where it is put, as a scanner on a wall, and nothing pushes it.
  bool fixed = false;
  Drive drive;
  std::optional<Turret> turret;
  std::optional<Gripper> gripper{};
  std::vector<SonarRing> sonars;
  std::vector<LaserScanner> lasers;
  std::vector<InfraredRing> infrareds;
  std::vector<BumperRing> bumpers;
  std::optional<Odometer> odometer;
  std::string urdf;  ///< The file's text, for viewers.

  /// Returns the ring of that name, or null.
  [[nodiscard]] const SonarRing* sonar(std::string_view ring) const;

  /// Returns what a sensor at that height sees of the robot: the convex plans of its parts at that height, in
  /// the base frame; empty if nothing is solid there. See sections_at().
  /// @param height  [m] height above the floor.
  [[nodiscard]] std::vector<Shape> section_at(double height) const;
};

/// Returns the plan of the parts. It is a circle if a ball or an upright cylinder centred on the z axis holds the plan
/// of all others; else it is the convex hull, where a round part counts as the polygon with 24 corners around it.
[[nodiscard]] Shape footprint_of(const std::vector<Part>& parts);

/// Returns the heights of the lowest (first) and highest (second) point of the parts [m].
[[nodiscard]] std::pair<double, double> height_range_of(const std::vector<Part>& parts);

}  // namespace orca::sim
