// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/base/result.hpp"
#include "orca/geometry/vec2.hpp"
#include "orca/idl/sensing.hpp"

namespace orca {

/// The outline of a robot, around the origin of its frame, x forward.
struct RobotOutline {
  double radius = 0.0;  ///< [m] of the circle that holds it; 0 beside a rectangle: it cuts no corner.
  double length = 0.0;  ///< [m] of the rectangle that holds it, too; 0: the circle is all.
  double width = 0.0;   ///< [m]

  [[nodiscard]] bool holds(Vec2 point) const;
};

/// Returns the place where a beam of a scan ends, robot frame. One that is too near to be measured ends at the sensor.
/// @pre  its range is a number.
[[nodiscard]] Vec2 end_of_beam(const idl::LaserRangeReadings& scan, std::size_t beam);

/// Returns whether some beams of a scan are too near to be measured, or end within 2 cm of the laser: something is at the laser, and nobody knows how far it
/// reaches. A robot must not drive by such a scan.
/// @thread  pure function; any thread.
[[nodiscard]] bool is_covered(const idl::LaserRangeReadings& scan);

/// Checks whether a sensor that looks ahead has read anything there: of its readings within 30 degrees of the robot's x axis half must
/// be numbers. One that does not look ahead is right, too: it may look to the back. A robot must not drive by readings
/// of which only those aside say something: it would take the way ahead for free.
/// @pre     check_reading() finds nothing wrong with it.
/// @errors  invalid_argument, with the count of readings that say nothing.
/// @thread  pure function, as the next two; any thread.
[[nodiscard]] Status check_view_ahead(const idl::LaserRangeReadings& scan);
[[nodiscard]] Status check_view_ahead(const idl::SonarRangeReadings& round);
[[nodiscard]] Status check_view_ahead(const idl::InfraredRangeReadings& round);

/// Checks whether a sensor looks ahead at all: within 30 degrees of the robot's x axis. A robot whose only sensor looks aside or to the back
/// would drive blindly.
/// @errors  invalid_argument, with what to correct.
/// @thread  pure function, as the next two; any thread.
[[nodiscard]] Status check_looks_ahead(const idl::LaserRangeReadings& scan);
[[nodiscard]] Status check_looks_ahead(const idl::SonarRangeReadings& round);
[[nodiscard]] Status check_looks_ahead(const idl::InfraredRangeReadings& round);

/// Says which beams of a scan must hold the robot where it is, for people: those that are too near to be measured, and those that
/// end within the robot's own outline. Empty if there are none.
/// @thread  pure function; any thread.
[[nodiscard]] std::string beams_at_robot(const idl::LaserRangeReadings& scan, const RobotOutline& robot);

}  // namespace orca
