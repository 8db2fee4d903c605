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
#include "orca/sim/mesh.hpp"
#include "orca/sim/sensors.hpp"

namespace orca::sim {

/// A pose in space: position [m] and unit quaternion. Here of a part in the robot's base frame B (x forward,
/// y left, z up, origin on the floor between the wheels). On a synchro base B is the body's frame, which is
/// the robot's frame R (x the way the wheels point) as long as they point ahead.
struct Pose3 {
  double x = 0.0, y = 0.0, z = 0.0;
  double qx = 0.0, qy = 0.0, qz = 0.0, qw = 1.0;
};

/// One solid of the robot, centred at its own frame but for a hull.
struct Part {
  struct Block {
    double x, y, z;  ///< Full lengths [m].
  };
  struct Cylinder {
    double radius;  ///< [m]
    double length;  ///< [m] Along z.
  };
  struct Ball {
    double radius;  ///< [m]
  };
  struct Hull {
    std::vector<Vec3> corners;  ///< Of a convex body, in the part's frame.
  };
  std::variant<Block, Cylinder, Ball, Hull> form;
  Pose3 X_BP;
};

/// How the wheels of a base work together; docs/simulation.md has the models.
enum class DriveKind {
  differential,  ///< Two wheels on one axle.
  synchro,       ///< Three wheels, steered and driven together; the body does not turn with them.
  holonomic,     ///< Three omnidirectional wheels, 120 degrees apart.
};

/// How the base moves. Speeds and accelerations are limits, > 0; those of a holonomic base hold for its speed
/// in whatever direction.
struct Drive {
  DriveKind kind = DriveKind::differential;
  double max_speed = 0.0;              ///< [m/s]
  double max_turn_rate = 0.0;          ///< [rad/s]
  double max_acceleration = 0.0;       ///< [m/s2]
  double max_turn_acceleration = 0.0;  ///< [rad/s2]
  double track = 0.0;                  ///< [m] Diameter of the circle through the wheels' contact points.
  double wheel_diameter = 0.0;         ///< [m]
  Duration lag{0};                     ///< Time constant of the first-order answer to a command.
  Duration dead_time{0};               ///< From a command to the first effect.
  // For those who steer the base (thesis 8.4.1); the simulation itself does not use these.
  double steer_gain = 1.0;                         ///< [1/s] Turn rate per heading error.
  double speed_step = 0.0;                         ///< [m/s] Smallest change of speed worth a command.
  double big_turn_angle = 0.5 * std::numbers::pi;  ///< [rad] Towards larger ones it slows down,
  double big_turn_speed = 0.0;                     ///< [m/s] to this speed at most.
};

/// A turret: an upright axis of its own on top of the base, with sensors on it. It turns without end, and its
/// collision geometry is round, so that turning moves nothing but sensors.
struct Turret {
  std::string joint;              ///< The URDF joint that turns.
  double max_speed = 0.0;         ///< [rad/s]
  double max_acceleration = 0.0;  ///< [rad/s2]
  Duration period{0};             ///< From one reading of its angle to the next.
  Vec2 axis;                      ///< [m] Where it stands in the base frame.
};

/// A ring of sonar transducers. Number k looks along first_angle + k * pitch from the ring's centre and sits
/// `radius` from it in that direction; an uneven ring lists where each looks, and may list where each sits.
struct SonarRing {
  std::string name;
  std::size_t count = 0;
  double first_angle = 0.0;        ///< [rad] In the base frame, counter-clockwise from ahead.
  double pitch = 0.0;              ///< [rad] Positive: counter-clockwise.
  std::vector<double> angles;      ///< [rad] Of each transducer; empty: evenly spaced as above.
  std::vector<Vec2> positions;     ///< [m] Of each transducer about the centre; empty: on the circle.
  std::vector<double> heights;     ///< [m] Of each transducer above the link; empty: all at its height.
  double half_lobe = 0.0;          ///< [rad] Half the opening of the cone.
  double min_range = 0.0;          ///< [m] Nearer echoes read as this.
  double max_range = 0.0;          ///< [m] What no echo reads as.
  double quantum = 0.0;            ///< [m] Step of the device's readings; 0: none.
  double radius = 0.0;             ///< [m]
  Duration period{0};              ///< For all of them, one after the other.
  std::string link;                ///< The URDF link at the ring's centre.
  Pose2 center;                    ///< Of that link in the base frame.
  double height = 0.0;             ///< [m] Of that link above the floor.
  bool on_turret = false;          ///< Whether that link turns with the turret.
  std::vector<std::size_t> order;  ///< Firing order, a permutation of 0 .. count - 1.
  std::size_t parallel = 1;        ///< So many that follow each other in `order` fire at once.

  /// Where transducer `k` sits and looks, in the base frame.
  [[nodiscard]] Pose2 transducer(std::size_t k) const;
  /// How high transducer `k` sits above the floor [m].
  [[nodiscard]] double height_of(std::size_t k) const {
    return heights.empty() ? height : height + heights[k];
  }
};

/// The device that counts wheel travel.
struct Odometer {
  Duration period{0};
};

/// Everything the simulation knows of a type of robot. A plain value; see read_robot().
struct RobotModel {
  std::string name;  ///< Of the URDF's <robot>.
  std::string vendor;
  std::string model;
  double radius = 0.0;         ///< [m] Of the body.
  double bumper_radius = 0.0;  ///< [m] Of what touches first.
  double mass = 0.0;           ///< [kg] Of all links.
  double yaw_inertia = 0.0;    ///< [kg m2] About the base frame's z axis.
  std::vector<Part> parts;     ///< Collision geometry; never empty.
  Shape footprint;             ///< The parts' plan in the base frame: a circle or a convex outline.
  double bottom = 0.0;         ///< [m] Lowest point of the parts.
  double top = 0.0;            ///< [m] Highest point of the parts.
  Drive drive;
  std::optional<Turret> turret;
  std::vector<SonarRing> sonars;
  std::vector<LaserScanner> lasers;
  std::vector<InfraredRing> infrareds;
  std::vector<BumperRing> bumpers;
  std::optional<Odometer> odometer;
  std::string urdf;  ///< The file's text, for viewers.

  /// The ring of that name, or null.
  [[nodiscard]] const SonarRing* sonar(std::string_view ring) const;
};

/// The plan of the parts: a circle if all are balls and upright cylinders centred on the z axis, else the
/// convex hull, where a round part counts as the polygon with 24 corners around it.
[[nodiscard]] Shape footprint_of(const std::vector<Part>& parts);

/// Lowest (first) and highest (second) point of the parts [m].
[[nodiscard]] std::pair<double, double> height_range_of(const std::vector<Part>& parts);

}  // namespace orca::sim
