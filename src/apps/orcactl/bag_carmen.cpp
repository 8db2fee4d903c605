// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "bag_carmen.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <numbers>
#include <optional>

#include "orca/geometry/pose2.hpp"
#include "orca/idl/object.hpp"
#include "orca/idl/sensing.hpp"
#include "table.hpp"

namespace orca::orcactl {
namespace {

constexpr double kHalfTurn = std::numbers::pi;
constexpr double kSlack = 0.02;  // [rad] by which 180 degrees may be missed: one beam is one degree at most

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) {
    char digits[32];
    std::snprintf(digits, sizeof digits, " %.6f", value);
    text += digits;
  }
  return text;
}

// Returns the end of each line: when it was sensed, on which host, and when it was logged.
std::string ending(double time) { return numbers({time}) + " orca" + numbers({time}) + "\n"; }

std::string pose(const Pose2& at) { return numbers({at.x, at.y, at.yaw}); }

// The robot's last odometry.
struct Place {
  Pose2 X_OB;
  double speed = 0.0;
  double turn_rate = 0.0;
};

std::string odometry_line(const Place& place, double time) {
  return "ODOM" + pose(place.X_OB) + numbers({place.speed, place.turn_rate, 0.0}) + ending(time);
}

std::string scan_line(const idl::LaserRangeReadings& scan, const Place& place, double time) {
  std::string ranges = " " + std::to_string(scan.ranges().size());
  for (const double range : scan.ranges()) {
    char digits[32];
    std::snprintf(digits, sizeof digits, " %.3f", range);
    ranges += digits;
  }
  const double view =
      scan.angle_increment() * static_cast<double>(std::max<std::size_t>(scan.ranges().size(), 1) - 1);
  const Pose2 X_BL{scan.pose().position().x(), scan.pose().position().y(), scan.pose().rotation().yaw()};
  const Pose2 X_OL = place.X_OB * X_BL;
  if (std::abs(view - kHalfTurn) < kSlack)
    return "FLASER" + ranges + pose(X_OL) + pose(place.X_OB) + ending(time);
  const std::string head =
      " 0" + numbers({scan.angle_start(), view, scan.angle_increment(), scan.max_range(), 0.0}) + " 0";
  return "ROBOTLASER1" + head + ranges + " 0" + pose(X_OL) + pose(place.X_OB) +
         numbers({place.speed, place.turn_rate, 0.0, 0.0, 0.0}) + ending(time);
}

}  // namespace

Status print_carmen_log(const recording::ObjectReader& reader, const std::set<std::string>& ports) {
  std::optional<Place> place;
  std::size_t scans = 0;
  std::size_t early = 0;  // scans before the first odometry
  const Status read = reader.objects(ports, [&](const recording::RecordedObject& one) {
    const double time = to_seconds(one.object.stamp().time_since_epoch());
    if (const auto odometry = object_cast<idl::Odometry>(one.object)) {
      place = Place{{odometry->x(), odometry->y(), odometry->steer_angle()},
                    odometry->translational_velocity(),
                    odometry->steering_velocity()};
      print(odometry_line(*place, time));
    } else if (const auto scan = object_cast<idl::LaserRangeReadings>(one.object)) {
      if (place) print(scan_line(*scan, *place, time));
      place ? ++scans : ++early;
    }
    return true;
  });
  if (!read.ok()) return read;
  if (scans > 0) return ok();
  return fail(Code::not_found,
              early > 0 ? "there is no odometry before the scans; record the port of the base as well"
                        : "there are no scans of a laser in the recording");
}

}  // namespace orca::orcactl
