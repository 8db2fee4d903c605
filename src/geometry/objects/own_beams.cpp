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

// A laser may say that it measures from nothing on, but what ends there is a cover.
double nearest_of(const idl::LaserRangeReadings& scan) {
  constexpr double kCover = 0.02;  // [m]
  return std::max(scan.min_range(), kCover);
}

// Returns whether a beam has met something too near to be measured. One that has measured nothing (NaN) has not.
bool is_too_near(const idl::LaserRangeReadings& scan, double range) {
  return range <= nearest_of(scan) && range < scan.max_range();
}

// The readings of a sensor that look ahead.
struct View {
  std::size_t ahead = 0;
  std::size_t unread = 0;

  void add(double yaw, double range) {
    constexpr double kAhead = std::numbers::pi / 6.0 + 1e-6;  // Rings of six have sonars at 30 degrees.
    if (std::abs(wrapped(yaw)) > kAhead) return;
    ++ahead;
    if (std::isnan(range)) ++unread;
  }
  [[nodiscard]] Status check() const {
    if (2 * unread <= ahead) return ok();
    return fail(Code::invalid_argument,
                std::to_string(unread) + " of its " + std::to_string(ahead) +
                    " readings ahead of the robot are no numbers; expected at most half");
  }
};

View view_of(const idl::LaserRangeReadings& scan) {
  View view;
  for (std::size_t i = 0; i < scan.ranges().size(); ++i)
    view.add(scan.pose().rotation().yaw() + angle_of(scan, i), scan.ranges()[i]);
  return view;
}

template <class Round>
View view_of_round(const Round& round) {
  View view;
  for (std::size_t i = 0; i < std::min(round.ranges().size(), round.poses().size()); ++i)
    view.add(round.poses()[i].rotation().yaw(), round.ranges()[i]);
  return view;
}

Status check_any_ahead(const View& view, const std::string& parts, const std::string& what_to_correct) {
  if (view.ahead > 0) return ok();
  return fail(Code::invalid_argument,
              "none of its " + parts +
                  " looks ahead, within 30 degrees of the robot's x axis; in the robot's file, "
                  "is " +
                  what_to_correct + " right?");
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

Status check_view_ahead(const idl::LaserRangeReadings& scan) { return view_of(scan).check(); }

Status check_looks_ahead(const idl::LaserRangeReadings& scan) {
  return check_any_ahead(view_of(scan), "beams", "the rpy of its joint");
}

Status check_looks_ahead(const idl::SonarRangeReadings& round) {
  return check_any_ahead(view_of_round(round), "sonars", "first_angle, or angles, of its ring");
}

Status check_looks_ahead(const idl::InfraredRangeReadings& round) {
  return check_any_ahead(view_of_round(round), "sensors", "first_angle of its ring");
}

Status check_view_ahead(const idl::SonarRangeReadings& round) { return view_of_round(round).check(); }

Status check_view_ahead(const idl::InfraredRangeReadings& round) { return view_of_round(round).check(); }

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
    text = covered.text(scan.ranges().size()) + "are nearer than " + in_metres(nearest_of(scan)) +
           ": something is at the laser";
  if (own.count > 0)
    text += (text.empty() ? "" : "; ") + own.text(scan.ranges().size()) +
            "end within the robot's own outline: it sees itself; the parameter ignore of its LaserServer "
            "leaves beams out";
  return text;
}

}  // namespace orca
