// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"

namespace orca::emulators {

/// What a gripper of two paddles on a lift tells of itself.
struct GripperLook {
  bool open = false;           ///< The paddles are at their open end.
  bool closed = false;         ///< The paddles are closed, on each other or on something.
  bool paddles_move = false;   ///< The paddles open or close.
  bool up = false;             ///< The lift is at its upper end.
  bool down = false;           ///< The lift is at its lower end.
  bool lift_moves = false;     ///< The lift goes up or down.
  bool inner_beam = false;     ///< Something interrupts the beam near the robot.
  bool outer_beam = false;     ///< Something interrupts the beam near the tips of the paddles.
  bool left_contact = false;   ///< The left paddle is pressed against something.
  bool right_contact = false;  ///< The right paddle is pressed against something.
};

/// What the motors of a gripper begin to do. Paddles and lift move each for itself, and stop at their ends.
enum class GripperMove {
  open,       ///< Open the paddles.
  close,      ///< Close the paddles.
  stop,       ///< Stop the paddles.
  up,         ///< Raise the lift.
  down,       ///< Lower the lift.
  stop_lift,  ///< Stop the lift.
};

/// The body of a robot, as its controller drives and senses it. The simulator is one; a test may have a simpler one.
///
/// Thread contract: the firmware's.
class Body {
 public:
  virtual ~Body() = default;
  /// Gives the wheels a velocity, from now on. @param velocity  `left` is 0 unless the base is holonomic.
  virtual void drive(const Twist2& velocity) = 0;
  /// Returns where the wheels say that the robot is, from where it was at the start.
  [[nodiscard]] virtual Pose2 odometry() const = 0;
  /// Returns the velocity of the wheels.
  [[nodiscard]] virtual Twist2 velocity() const = 0;
  /// Returns the distance that a sonar hears [m]; nothing if it hears no echo.
  [[nodiscard]] virtual std::optional<double> sonar(int number) const = 0;
  /// Returns the pressed bumpers, a bit each: front in the low byte, rear in the high byte; of a bumper that goes all around, bit i
  /// is switch i, counted from ahead to the left.
  [[nodiscard]] virtual std::uint16_t bumpers() const { return 0; }
  [[nodiscard]] virtual bool is_stalled() const { return false; }
  /// Returns the places in front without a floor, a bit each, from the left to the right.
  [[nodiscard]] virtual std::uint8_t cliffs() const { return 0; }
  /// Returns whether the wheels hang, because the robot was lifted.
  [[nodiscard]] virtual bool is_lifted() const { return false; }
  /// Makes the gripper move, from now on. A body without one passes it over.
  virtual void move_gripper(GripperMove) {}
  /// Returns what the gripper tells of itself; nothing if the body has none. It has one all the time, or never.
  [[nodiscard]] virtual std::optional<GripperLook> gripper() const { return std::nullopt; }
  /// Returns the voltage of its battery [V]; nothing if it is not known, so that the controller reports one of its own.
  [[nodiscard]] virtual std::optional<double> battery_voltage() const { return std::nullopt; }
  /// Returns whether the battery is charged; nothing if that is not known.
  [[nodiscard]] virtual std::optional<bool> is_charged() const { return std::nullopt; }
};

/// A turn of a scanning laser's mirror.
struct MirrorTurn {
  TimePoint stamp{};               ///< When it was measured.
  double first_angle = 0.0;        ///< [rad] of the first beam from ahead, positive to the left.
  double step = 0.0;               ///< [rad] from beam to beam; positive: to the left.
  std::span<const double> ranges;  ///< [m] one per beam; infinite: no return.
  bool upside_down =
      false;  ///< Whether the laser hangs upside down. The angles are as it sees them all the same.
};

/// What a scanning laser's mirror shows it.
///
/// Thread contract: the firmware's.
class Mirror {
 public:
  virtual ~Mirror() = default;
  /// Returns the last turn; nothing before the first. It is valid until the firmware returns.
  [[nodiscard]] virtual std::optional<MirrorTurn> last_turn() const = 0;
};

}  // namespace orca::emulators
