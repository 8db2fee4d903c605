// SPDX-License-Identifier: LGPL-3.0-or-later
#include "convert.hpp"

#include <algorithm>
#include <utility>

#include "orca/base/portable_math.hpp"

namespace orca::ros {
namespace {

constexpr std::int64_t kSecond = 1'000'000'000;
constexpr std::array<std::size_t, 3> kPlaneOfSix{0, 1, 5};
constexpr geometry_msgs::Quaternion kOpticalInCamera{-0.5, 0.5, -0.5, 0.5};

geometry_msgs::Quaternion product(const geometry_msgs::Quaternion& a, const geometry_msgs::Quaternion& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

}  // namespace

std::string context_of(const idl::OrcaObject& object) {
  const std::size_t slash = object.origin().rfind('/');
  return slash == std::string::npos ? "" : object.origin().substr(0, slash + 1);
}

std::string sensor_frame(const idl::OrcaObject& object) {
  return object.origin().empty() ? "sensor" : object.origin();
}

std::string sensor_frame(const idl::OrcaObject& object, std::size_t index, std::size_t count) {
  return sensor_frame(object) + (count == 1 ? "" : "_" + std::to_string(index));
}

std::string optical_frame(const idl::OrcaObject& object) { return sensor_frame(object) + "_optical"; }

std::string camera_frame(const std::string& optical_frame) {
  constexpr std::string_view kOptical = "_optical";
  if (!optical_frame.ends_with(kOptical)) return optical_frame;
  return optical_frame.substr(0, optical_frame.size() - kOptical.size());
}

idl::Rotation3D to_optical(const idl::Rotation3D& rotation) {
  return to_rotation(product(to_quaternion(rotation), kOpticalInCamera));
}

idl::Rotation3D from_optical(const idl::Rotation3D& rotation) {
  constexpr geometry_msgs::Quaternion kCameraInOptical{0.5, -0.5, 0.5, 0.5};
  return to_rotation(product(to_quaternion(rotation), kCameraInOptical));
}

builtin_interfaces::Time to_ros_time(TimePoint time) {
  const std::int64_t ns = time.time_since_epoch().count();
  const std::int64_t rest = ns % kSecond;  // in the direction of zero
  const bool is_before = rest < 0;
  return {static_cast<std::int32_t>(ns / kSecond - (is_before ? 1 : 0)),
          static_cast<std::uint32_t>(rest + (is_before ? kSecond : 0))};
}

TimePoint to_instant(const builtin_interfaces::Time& time) {
  return TimePoint(Duration(time.sec * kSecond + time.nanosec));
}

std_msgs::Header make_header(TimePoint stamp, std::string frame) {
  return {to_ros_time(stamp), std::move(frame)};
}

geometry_msgs::Quaternion to_quaternion(const idl::Rotation3D& rotation) {
  const double cr = portable::cos(0.5 * rotation.roll());
  const double sr = portable::sin(0.5 * rotation.roll());
  const double cp = portable::cos(0.5 * rotation.pitch());
  const double sp = portable::sin(0.5 * rotation.pitch());
  const double cy = portable::cos(0.5 * rotation.yaw());
  const double sy = portable::sin(0.5 * rotation.yaw());
  return {sr * cp * cy - cr * sp * sy, cr * sp * cy + sr * cp * sy, cr * cp * sy - sr * sp * cy,
          cr * cp * cy + sr * sp * sy};
}

idl::Rotation3D to_rotation(const geometry_msgs::Quaternion& quaternion) {
  const auto [x, y, z, w] = quaternion;
  const double square = x * x + y * y + z * z + w * w;
  idl::Rotation3D rotation;
  if (!(square > 0.0)) return rotation;  // also where one is NaN
  const double s = 2.0 / square;
  rotation.roll(portable::atan2(s * (w * x + y * z), 1.0 - s * (x * x + y * y)));
  rotation.pitch(portable::asin(std::clamp(s * (w * y - z * x), -1.0, 1.0)));
  rotation.yaw(portable::atan2(s * (w * z + x * y), 1.0 - s * (y * y + z * z)));
  return rotation;
}

geometry_msgs::Pose to_ros_pose(const idl::Point& position, const idl::Rotation3D& rotation) {
  return {{position.x(), position.y(), position.z()}, to_quaternion(rotation)};
}

geometry_msgs::Pose to_ros_pose(const Pose2& pose) {
  idl::Rotation3D rotation;
  rotation.yaw(pose.yaw);
  return to_ros_pose(make_point(pose.x, pose.y, 0.0), rotation);
}

Pose2 to_plane(const geometry_msgs::Pose& pose) {
  return {pose.position.x, pose.position.y, to_rotation(pose.orientation).yaw()};
}

geometry_msgs::Transform to_transform(const geometry_msgs::Pose& pose) {
  return {{pose.position.x, pose.position.y, pose.position.z}, pose.orientation};
}

std::array<double, 36> to_six(const std::array<double, 9>& plane) {
  std::array<double, 36> six{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      six[6 * kPlaneOfSix[row] + kPlaneOfSix[column]] = plane[3 * row + column];
  return six;
}

std::array<double, 9> from_six(const std::array<double, 36>& six) {
  std::array<double, 9> plane{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      plane[3 * row + column] = six[6 * kPlaneOfSix[row] + kPlaneOfSix[column]];
  return plane;
}

}  // namespace orca::ros
