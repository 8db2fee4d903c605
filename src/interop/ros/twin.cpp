// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/ros/twin.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cdr_writer.hpp"
#include "orca/base/portable_math.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"

namespace orca::ros {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;

// Returns the context of a component: "Dewey/" of "Dewey/base".
std::string context_of(const idl::OrcaObject& object) {
  const std::size_t slash = object.origin().rfind('/');
  return slash == std::string::npos ? "" : object.origin().substr(0, slash + 1);
}

std::string sensor_frame(const idl::OrcaObject& object) {
  return object.origin().empty() ? "sensor" : object.origin();
}

void put_time(CdrWriter& out, TimePoint time) {
  const std::int64_t ns = time.time_since_epoch().count();
  const std::int64_t seconds = ns / kSecond - (ns % kSecond < 0 ? 1 : 0);
  out.put(static_cast<std::int32_t>(seconds));
  out.put(static_cast<std::uint32_t>(ns - seconds * kSecond));
}

void put_header(CdrWriter& out, TimePoint stamp, const std::string& frame) {
  put_time(out, stamp);
  out.put(std::string_view(frame));
}

struct Rotation {
  double roll = 0.0;
  double pitch = 0.0;
  double yaw = 0.0;
};

void put_quaternion(CdrWriter& out, const Rotation& rotation) {
  const double cr = portable::cos(0.5 * rotation.roll);
  const double sr = portable::sin(0.5 * rotation.roll);
  const double cp = portable::cos(0.5 * rotation.pitch);
  const double sp = portable::sin(0.5 * rotation.pitch);
  const double cy = portable::cos(0.5 * rotation.yaw);
  const double sy = portable::sin(0.5 * rotation.yaw);
  out.put(sr * cp * cy - cr * sp * sy);
  out.put(cr * sp * cy + sr * cp * sy);
  out.put(cr * cp * sy - sr * sp * cy);
  out.put(cr * cp * cy + sr * sp * sy);
}

// Position and orientation; a Transform travels like a Pose.
void put_pose(CdrWriter& out, double x, double y, double z, const Rotation& rotation) {
  for (const double number : {x, y, z}) out.put(number);
  put_quaternion(out, rotation);
}

void put_pose(CdrWriter& out, const Pose2& pose) { put_pose(out, pose.x, pose.y, 0.0, {.yaw = pose.yaw}); }

void put_pose(CdrWriter& out, const idl::Point& position, const idl::Rotation3D& rotation) {
  put_pose(out, position.x(), position.y(), position.z(),
           {rotation.roll(), rotation.pitch(), rotation.yaw()});
}

// Puts the covariance of x, y and a heading in its place in that of six coordinates.
void put_covariance(CdrWriter& out, const std::array<double, 9>& plane) {
  constexpr std::array<std::size_t, 3> kPlaces{0, 1, 5};
  std::array<double, 36> all{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      all[6 * kPlaces[row] + kPlaces[column]] = plane[3 * row + column];
  for (const double number : all) out.put(number);
}

void put_twist(CdrWriter& out, double forward, double left, double turn) {
  for (const double number : {forward, left, 0.0, 0.0, 0.0, turn}) out.put(number);
}

// REP 117: what was not heard is infinitely far, what is too near is minus infinity.
float as_range(double range, const idl::LaserRangeReadings& scan) {
  if (range >= scan.max_range()) return std::numeric_limits<float>::infinity();
  if (range < scan.min_range()) return -std::numeric_limits<float>::infinity();
  return static_cast<float>(range);
}

void put(CdrWriter& out, const idl::LaserRangeReadings& scan, TimePoint stamp) {
  const std::size_t count = scan.ranges().size();
  const double steps = count == 0 ? 0.0 : static_cast<double>(count - 1);
  put_header(out, stamp, sensor_frame(scan));
  for (const double number :
       {scan.angle_start(), scan.angle_start() + steps * scan.angle_increment(), scan.angle_increment(),
        scan.time_increment(), steps * scan.time_increment(), scan.min_range(), scan.max_range()})
    out.put(static_cast<float>(number));
  out.put_count(count);
  for (const double range : scan.ranges()) out.put(as_range(range, scan));
  out.put_count(0);
}

void put(CdrWriter& out, const idl::Odometry& odometry, TimePoint stamp) {
  const std::string context = context_of(odometry);
  put_header(out, stamp, context + "odom");
  out.put(std::string_view(context + "base_link"));
  put_pose(out, plane_pose(odometry));
  put_covariance(out, odometry.covariance());
  put_twist(out, odometry.translational_velocity(), odometry.sideways_velocity(),
            odometry.steering_velocity());
  put_covariance(out, {});
}

void put(CdrWriter& out, const idl::RobotPose& pose, TimePoint stamp) {
  put_header(out, stamp, "map");
  put_pose(out, plane_pose(pose));
  put_covariance(out, pose.covariance());
}

void put(CdrWriter& out, const idl::GoalPoint& goal, TimePoint stamp) {
  const idl::Point& place = goal.coordinate().point();
  const double yaw = goal.use_orientation() ? goal.orientation().orientation().yaw() : 0.0;
  put_header(out, stamp, "map");
  put_pose(out, place.x(), place.y(), place.z(), {.yaw = yaw});
}

void put(CdrWriter& out, const idl::Path& path, TimePoint stamp) {
  put_header(out, stamp, "map");
  out.put_count(path.poses().size());
  for (const idl::Pose3D& pose : path.poses()) {
    put_header(out, to_time_point(pose.stamp()), "map");
    put_pose(out, pose.position(), pose.rotation());
  }
}

void put(CdrWriter& out, const idl::OccupancyGrid& grid, TimePoint stamp) {
  put_header(out, stamp, "map");
  put_time(out, to_time_point(grid.corner().stamp()));
  out.put(static_cast<float>(grid.resolution()));
  out.put(grid.columns());
  out.put(grid.rows());
  put_pose(out, plane_pose(grid.corner()));
  out.put_count(grid.cells().size());
  out.append(std::as_bytes(std::span(grid.cells())));  // 255 is -1 there: not known
}

void put(CdrWriter& out, const idl::Image& image, TimePoint stamp) {
  // In the order of idl::ImageEncoding.
  constexpr std::array<std::string_view, 7> kEncodings{"mono8", "mono16",      "rgb8", "bgr8",
                                                       "rgba8", "bayer_rggb8", "16UC1"};
  put_header(out, stamp, sensor_frame(image));
  out.put(image.height());
  out.put(image.width());
  out.put(kEncodings[std::min<std::size_t>(image.encoding(), kEncodings.size() - 1)]);
  out.put(false);  // the low byte comes first
  out.put(image.step());
  out.put_count(image.data().size());
  out.append(std::as_bytes(std::span(image.data())));
}

void put(CdrWriter& out, const idl::Battery& battery, TimePoint stamp) {
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  constexpr std::uint8_t kCharging = 1;
  constexpr std::uint8_t kDischarging = 2;
  put_header(out, stamp, context_of(battery) + "base_link");
  out.put(static_cast<float>(battery.voltage()));
  out.put(static_cast<float>(battery.temperature()));
  out.put(static_cast<float>(battery.current()));
  for (int i = 0; i < 3; ++i) out.put(kUnknown);  // charge and capacities in Ah
  out.put(static_cast<float>(battery.charge()));
  out.put(battery.charging() ? kCharging : kDischarging);
  out.put(std::uint8_t{0});  // health and technology are not known
  out.put(std::uint8_t{0});
  out.put(true);
  out.put_count(0);
  out.put_count(0);
  out.put(std::string_view(battery.name()));
  out.put(std::string_view());
}

void put(CdrWriter& out, const idl::LogRecord& line, TimePoint stamp) {
  put_time(out, stamp);
  out.put(static_cast<std::uint8_t>(10 * (static_cast<int>(line.level()) + 1)));  // 10 debug to 40 error
  out.put(std::string_view(line.source()));
  out.put(std::string_view(line.text()));
  out.put(std::string_view());  // file and function
  out.put(std::string_view());
  out.put(std::uint32_t{0});
}

// Writes an object if it is of the type T, or of one that is derived from it.
template <class T>
bool put_as(std::string_view name, const ObjectRef& object, std::optional<RosMessage>& twin) {
  const ObjectPtr<T> typed = object_cast<T>(object);
  if (!typed) return false;
  CdrWriter out;
  put(out, *typed, object.stamp());
  twin = RosMessage{name, out.take()};
  return true;
}

RosMessage transform(TimePoint stamp, const std::string& parent, const std::string& child,
                     const auto& put_transform) {
  CdrWriter out;
  out.put_count(1);
  put_header(out, stamp, parent);
  out.put(std::string_view(child));
  put_transform(out);
  return {"tf2_msgs/msg/TFMessage", out.take()};
}

}  // namespace

std::optional<RosMessage> ros_twin(const ObjectRef& object) {
  std::optional<RosMessage> twin;
  (void)(put_as<idl::LaserRangeReadings>("sensor_msgs/msg/LaserScan", object, twin) ||
         put_as<idl::Odometry>("nav_msgs/msg/Odometry", object, twin) ||
         put_as<idl::RobotPose>("geometry_msgs/msg/PoseWithCovarianceStamped", object, twin) ||
         put_as<idl::GoalPoint>("geometry_msgs/msg/PoseStamped", object, twin) ||
         put_as<idl::Path>("nav_msgs/msg/Path", object, twin) ||
         put_as<idl::OccupancyGrid>("nav_msgs/msg/OccupancyGrid", object, twin) ||
         put_as<idl::Image>("sensor_msgs/msg/Image", object, twin) ||
         put_as<idl::Battery>("sensor_msgs/msg/BatteryState", object, twin) ||
         put_as<idl::LogRecord>("rcl_interfaces/msg/Log", object, twin));
  return twin;
}

std::optional<RosMessage> FrameTree::hear(const ObjectRef& object) {
  const std::string context = context_of(object.header());
  const std::string base = context + "base_link";
  const auto level = [](const Pose2& pose) { return [&pose](CdrWriter& out) { put_pose(out, pose); }; };
  if (const auto odometry = object_cast<idl::Odometry>(object)) {
    const Pose2& X_OB = odometry_[context] = plane_pose(*odometry);
    return transform(object.stamp(), context + "odom", base, level(X_OB));
  }
  if (const auto pose = object_cast<idl::RobotPose>(object)) {
    const Pose2 X_WB = plane_pose(*pose);
    const auto known = odometry_.find(context);
    if (known == odometry_.end()) return transform(object.stamp(), "map", base, level(X_WB));
    const Pose2 X_WO = X_WB * inverse(known->second);
    return transform(object.stamp(), "map", context + "odom", level(X_WO));
  }
  const auto mounted = [&](const idl::Pose3D& mount) {
    return transform(object.stamp(), base, sensor_frame(object.header()),
                     [&](CdrWriter& out) { put_pose(out, mount.position(), mount.rotation()); });
  };
  if (const auto scan = object_cast<idl::LaserRangeReadings>(object)) return mounted(scan->pose());
  if (const auto image = object_cast<idl::Image>(object)) return mounted(image->pose());
  return std::nullopt;
}

}  // namespace orca::ros
