// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/geometry/objects/own_beams.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "orca/base/portable_math.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/geometry/pose2.hpp"

namespace orca {
namespace {

double angle_of(const idl::LaserRangeReadings& scan, std::size_t beam) {
  return scan.angle_start() + scan.angle_increment() * static_cast<double>(beam);
}

// Some beams of a scan.
struct Sector {
  std::size_t count = 0;
  double from = std::numeric_limits<double>::infinity();  // [rad]
  double to = -std::numeric_limits<double>::infinity();   // [rad]

  void add(double angle) {
    ++count;
    from = std::min(from, angle);
    to = std::max(to, angle);
  }
  [[nodiscard]] std::string text(std::size_t all) const {
    constexpr double kDegree = std::numbers::pi / 180.0;
    char text[96];
    std::snprintf(text, sizeof text, "%zu of its %zu beams, from %.0f to %.0f deg, ", count, all,
                  from / kDegree, to / kDegree);
    return text;
  }
};

std::string in_metres(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%g m", length);
  return text;
}

// Returns whether a beam has met something too near to be measured. One that has measured nothing (NaN) has not.
bool is_too_near(const idl::LaserRangeReadings& scan, double range) {
  return range <= scan.min_range() && range < scan.max_range();
}

}  // namespace

bool RobotOutline::holds(Vec2 point) const {
  const bool is_rectangle = length > 0.0 && width > 0.0;
  if (is_rectangle && (std::abs(point.x) >= 0.5 * length || std::abs(point.y) >= 0.5 * width)) return false;
  return (is_rectangle && radius <= 0.0) || portable::hypot(point.x, point.y) < radius;
}

Vec2 end_of_beam(const idl::LaserRangeReadings& scan, std::size_t beam) {
  const Pose2 mount = plane_pose(scan.pose());
  const double range = scan.ranges()[beam] > scan.min_range() ? scan.ranges()[beam] : 0.0;
  return mount.position() + range * direction(mount.yaw + angle_of(scan, beam));
}

bool is_covered(const idl::LaserRangeReadings& scan) {
  return std::ranges::any_of(scan.ranges(), [&](double range) { return is_too_near(scan, range); });
}

std::string beams_at_robot(const idl::LaserRangeReadings& scan, const RobotOutline& robot) {
  Sector covered;
  Sector own;
  for (std::size_t i = 0; i < scan.ranges().size(); ++i) {
    const double range = scan.ranges()[i];
    if (!(range < scan.max_range())) continue;
    if (is_too_near(scan, range)) {
      covered.add(angle_of(scan, i));
    } else if (robot.holds(end_of_beam(scan, i))) {
      own.add(angle_of(scan, i));
    }
  }
  std::string text;
  if (covered.count > 0)
    text = covered.text(scan.ranges().size()) + "are nearer than its min_range of " +
           in_metres(scan.min_range()) + ": something is at the laser";
  if (own.count > 0)
    text += (text.empty() ? "" : "; ") + own.text(scan.ranges().size()) +
            "end within the robot's own outline: it sees itself; the parameter ignore of its LaserServer "
            "leaves beams out";
  return text;
}

}  // namespace orca
