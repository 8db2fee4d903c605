// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "orca/robot_file/devices.hpp"
#include "orca/sim/mesh.hpp"

namespace orca::sim {

using robot_file::Battery;
using robot_file::BumperRing;
using robot_file::Camera;
using robot_file::DeviceLabel;
using robot_file::Drive;
using robot_file::DriveKind;
using robot_file::Gripper;
using robot_file::Guesses;
using robot_file::InfraredRing;
using robot_file::LaserScanner;
using robot_file::Odometer;
using robot_file::SonarRing;
using robot_file::Turret;

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
  std::string link{};  ///< URDF link that it belongs to.
};

/// The description of a type of robot for the simulation, or of sensors without a robot. A plain value; see read_robot().
struct RobotModel : robot_file::Devices {
  std::string name;          ///< Name of the URDF's <robot>.
  double mass = 0.0;         ///< [kg] Mass of all links.
  double yaw_inertia = 0.0;  ///< [kg m2] Moment of inertia about the base frame's z axis.
  std::vector<Part> parts;   ///< Collision geometry; never empty.
  Shape footprint;           ///< The parts' plan in the base frame: a circle or a convex outline.
  double bottom = 0.0;       ///< [m] Lowest point of the parts.
  double top = 0.0;          ///< [m] Highest point of the parts.
  std::string urdf;          ///< The file's text, for viewers.

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
