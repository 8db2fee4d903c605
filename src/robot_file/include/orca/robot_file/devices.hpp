// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/portable_math.hpp"
#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/usual_figures.hpp"
#include "orca/robot_file/guesses.hpp"

namespace orca::robot_file {

inline constexpr Duration kShortestPeriod = 10ms;  ///< A device's: the tick of the simulator.

/// The words of a robot file about a device that are for its description only; the simulation does not use them.
struct DeviceLabel {
  std::string vendor;
  std::string model;
  std::string port;  ///< The connection of the real device, e.g. a serial line.
};

/// A scanning laser. Reading k looks along first_angle + k * pitch in the sensor frame; the beam sweeps from
/// the first to the last at an even pace.
struct LaserScanner {
  /// Directions between two angles [rad] in the sensor frame, from `from` counter-clockwise to `to`, both included.
  struct Sector {
    double from = 0.0;
    double to = 0.0;
    friend bool operator==(const Sector&, const Sector&) = default;
  };

  std::string name;
  std::size_t count = 0;  ///< Number of ranges in a scan.
  /// [rad] Direction of reading 0 in the sensor frame, counter-clockwise from its x axis.
  double first_angle = 0.0;
  double pitch = 0.0;       ///< [rad] Angle from one reading to the next, counter-clockwise positive.
  double min_range = 0.0;   ///< [m] Nearer things read as this.
  double max_range = 0.0;   ///< [m] The reading if nothing returns.
  double quantum = 0.0;     ///< [m] Step of the device's readings; 0: none.
  double divergence = 0.0;  ///< [rad] Opening angle of the beam, which gives the width of its spot.
  Duration period{0};       ///< Time from one scan to the next.
  Duration sweep{0};        ///< Time from the first reading of a scan to its last; at most `period`.
  std::string link;         ///< The URDF link at which it is mounted.
  Pose2 center;             ///< Pose of that link in the base frame.
  double height = 0.0;      ///< [m] Height of that link above the floor.
  bool on_turret = false;   ///< Whether that link turns with the turret.
  /// Whether it hangs upside down. The angles above are those of a level frame all the same; its own are their negatives.
  bool upside_down = false;
  /// Links of the robot itself that its beams meet; they pass through all others.
  std::vector<std::string> sees{};
  /// Directions in which it sees the robot itself: these readings are left out, as NaN.
  std::vector<Sector> ignore{};
  DeviceLabel label{};
  Guesses<RangeErrorGuess> errors{};

  /// Returns whether readings in a direction are left out. @param angle  [rad] in the sensor frame.
  [[nodiscard]] bool ignores(double angle) const;
};

/// A pinhole camera that looks level, along the x axis of its link.
struct Camera {
  std::string name;
  std::size_t width = 0;       ///< Pixels in a row.
  std::size_t height = 0;      ///< Number of rows.
  double field_of_view = 0.0;  ///< [rad] Angle between the outer edges of the outer columns, less than pi.
  Duration period{0};          ///< Time from one picture to the next.
  std::string link;            ///< The URDF link at which it is mounted.
  Pose2 center;                ///< Pose of that link in the base frame.
  double link_height = 0.0;    ///< [m] Height of that link above the floor.
  bool on_turret = false;      ///< Whether that link turns with the turret.
  DeviceLabel label{};

  /// Returns the distance of the picture from the pinhole [pixels].
  [[nodiscard]] double focal_length() const;
};

/// A ring of short-range infrared sensors, all of which measure at once. Number k looks along
/// first_angle + k * pitch from the ring's centre and sits `radius` from it in that direction.
struct InfraredRing {
  std::string name;
  std::size_t count = 0;
  /// [rad] Direction of sensor 0 in the base frame, counter-clockwise from ahead.
  double first_angle = 0.0;
  double pitch = 0.0;      ///< [rad] Angle from one sensor to the next, counter-clockwise positive.
  double half_beam = 0.0;  ///< [rad] Half the opening of the beam.
  double min_range = 0.0;  ///< [m] Nearer things read as this.
  double max_range = 0.0;  ///< [m] The reading if nothing is in sight.
  double radius = 0.0;     ///< [m] Distance of the sensors from the centre.
  Duration period{0};      ///< Time from one round to the next.
  std::string link;        ///< The URDF link at the ring's centre.
  Pose2 center;            ///< Pose of that link in the base frame.
  double height = 0.0;     ///< [m] Height of that link above the floor.
  bool on_turret = false;  ///< Whether that link turns with the turret.
  DeviceLabel label{};
  Guesses<RangeErrorGuess> errors{};

  /// Returns the pose of sensor `k` in the base frame; it looks along its x axis.
  [[nodiscard]] Pose2 sensor(std::size_t k) const {
    const double angle = first_angle + static_cast<double>(k) * pitch;
    const auto [cosine, sine] = portable::cos_sin(angle);
    return center * Pose2{radius * cosine, radius * sine, wrapped(angle)};
  }
};

/// A bumper divided into segments. Segment k is centred at the direction first_angle + k * pitch from the
/// base frame's origin and extends half a pitch to either side. A bumper that does not go all around may list the
/// directions of its segments.
struct BumperRing {
  std::string name;
  std::size_t count = 0;
  /// [rad] Direction of segment 0 in the base frame, counter-clockwise from ahead.
  double first_angle = 0.0;
  double pitch = 0.0;  ///< [rad] Width of a segment, and angle to the next one, counter-clockwise positive.
  std::vector<double> angles;  ///< [rad] Direction of each segment; empty: one after the other, as above.
  double radius = 0.0;         ///< [m] Radius of the bumper, which gives the segments' places.
  Duration period{0};          ///< Time from one reading to the next.
  DeviceLabel label{};

  /// Returns the pose of the middle of segment `k`, x axis outwards, in the base frame.
  [[nodiscard]] Pose2 segment(std::size_t k) const {
    const double angle = angles.empty() ? first_angle + static_cast<double>(k) * pitch : angles[k];
    const auto [cosine, sine] = portable::cos_sin(angle);
    return {radius * cosine, radius * sine, wrapped(angle)};
  }
};

/// The kinematics of a base; docs/simulated-devices.md has the models.
enum class DriveKind {
  differential,  ///< Two wheels on one axle.
  synchro,       ///< Three wheels, steered and driven together; the body does not turn with them.
  holonomic,     ///< Three omnidirectional wheels, 120 degrees apart.
};

/// Returns what robot files call a kind: "differential".
[[nodiscard]] std::string_view to_string(DriveKind kind);

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
  double height = 0.0;      ///< [m] Height of that link above the floor while the lift is down.
  double opening = 0.0;     ///< [m] Gap between the open paddles, > 0.
  double depth = 0.0;       ///< [m] Length of the paddles, along x from the root, > 0.
  double lift = 0.0;        ///< [m] How high the lift raises them, > 0.
  Duration paddle_time{0};  ///< Time from open to closed, the same back, > 0.
  Duration lift_time{0};    ///< Time from down to up, the same back, > 0.
  Duration period{0};       ///< Time from one reading of its state to the next.
  DeviceLabel label{};
};

/// The battery that drives the robot, as far as the simulator needs it.
struct Battery {
  double voltage = 0.0;  ///< [V] when it is full, > 0.
  Duration driving{0};   ///< Time for which it lasts at the greatest speed, > 0.
  Duration standing{0};  ///< Time for which it lasts at rest, at least `driving`.
  Duration charging{0};  ///< Time in which a charger fills it, > 0 and less than `standing`.
  Duration period{0};    ///< Time from one reading to the next.
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

/// The content of the element `<orca>` of a robot's file. A plain value; see read_devices().
struct Devices {
  std::string vendor;
  std::string model;
  double radius = 0.0;         ///< [m] Radius of the body.
  double bumper_radius = 0.0;  ///< [m] Radius of the parts that touch first.
  /// Whether it has no drive: it stays where it is put, as a scanner on a wall, and nothing pushes it.
  bool fixed = false;
  Drive drive;
  std::optional<Turret> turret;
  std::optional<Gripper> gripper{};
  std::optional<Battery> battery{};
  std::vector<SonarRing> sonars;
  std::vector<LaserScanner> lasers;
  std::vector<InfraredRing> infrareds;
  std::vector<Camera> cameras{};
  std::vector<BumperRing> bumpers;
  std::optional<Odometer> odometer;
};

}  // namespace orca::robot_file
