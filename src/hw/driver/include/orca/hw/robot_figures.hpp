// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orca/component/host.hpp"
#include "orca/geometry/error_guess.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/vec2.hpp"
#include "orca/idl/hardware.hpp"

namespace orca::hw {

/// What a driver wants to know of its robot, from the file that the simulator reads, too (docs/robot-files.md). A plain value.
struct RobotFigures {
  struct Wheels {
    idl::DriveType type = idl::DIFFERENTIAL;
    double max_speed = 0.0;                  ///< [m/s]
    double max_turn_rate = 0.0;              ///< [rad/s]
    double max_acceleration = 0.0;           ///< [m/s2]
    double track = 0.0;                      ///< [m] Diameter of the circle through the wheels.
    std::optional<double> steer_gain{};      ///< [1/s] As in DriveLimits; nothing: the file does not say it.
    std::optional<double> big_turn_angle{};  ///< [rad] Likewise.
    std::optional<double> big_turn_speed{};  ///< [m/s] Likewise.
  };
  struct Laser {
    std::string name;
    Pose2 place;          ///< In the robot frame.
    double height = 0.0;  ///< [m] Above the floor.
    bool upside_down = false;
    RangeErrorGuess errors{};
  };

  double radius = 0.0;         ///< [m] Of the circle that holds the body.
  double bumper_radius = 0.0;  ///< [m] Of the parts that touch first.
  std::optional<Vec2> size{};  ///< [m] Length and width of its plan; 0: it is round; nothing: not known.
  std::optional<Wheels> wheels{};
  WheelErrorGuess wheel_errors{};  ///< The usual ones if the file does not say them.
  bool says_wheel_errors = false;
  RangeErrorGuess sonar_errors{};
  std::vector<double> bumpers{};  ///< [rad] Directions in which those of all rings face.
  std::vector<Laser> lasers{};
  std::optional<std::string> gripper{};  ///< Its link; nothing: it has none.
};

/// Reads a robot file.
/// @param path    empty: there is none, and nothing is wrong.
/// @param faults  gets what is wrong, as faults of the parameter `robot`.
/// @return the figures; nothing without a file, and if something is wrong.
/// @thread  any.
[[nodiscard]] std::optional<RobotFigures> read_robot_figures(const std::string& path,
                                                             std::vector<HardwareFault>& faults);

}  // namespace orca::hw
