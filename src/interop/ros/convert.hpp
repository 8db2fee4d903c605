// SPDX-License-Identifier: LGPL-3.0-or-later
// The parts that messages of ROS share, from and to those of Orca's objects.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/idl/geometry.hpp"
#include "orca/idl/object.hpp"
#include "orca/ros/generated/messages.hpp"

namespace orca::ros {

/// The longest name of a frame that is remembered when others say it [bytes].
inline constexpr std::size_t kLongestFrame = 256;

/// Returns the context of the component that an object comes from: "Dewey/" of "Dewey/base".
[[nodiscard]] std::string context_of(const idl::OrcaObject& object);
/// Returns the frame of the sensor that an object comes from.
[[nodiscard]] std::string sensor_frame(const idl::OrcaObject& object);
/// Returns the frame of one sensor of a ring of so many.
[[nodiscard]] std::string sensor_frame(const idl::OrcaObject& object, std::size_t index, std::size_t count);

/// Returns the frame in which a camera's images are (REP 103): z along the line of sight, x to the right.
[[nodiscard]] std::string optical_frame(const idl::OrcaObject& object);
/// Returns the name of the camera whose optical frame that is.
[[nodiscard]] std::string camera_frame(const std::string& optical_frame);
/// Turn the axes of a camera as Orca has them, x along the line of sight and z up, into those of its optical frame, and back.
[[nodiscard]] idl::Rotation3D to_optical(const idl::Rotation3D& rotation);
[[nodiscard]] idl::Rotation3D from_optical(const idl::Rotation3D& rotation);

[[nodiscard]] builtin_interfaces::Time to_ros_time(TimePoint time);
[[nodiscard]] TimePoint to_instant(const builtin_interfaces::Time& time);
[[nodiscard]] std_msgs::Header make_header(TimePoint stamp, std::string frame);

[[nodiscard]] geometry_msgs::Quaternion to_quaternion(const idl::Rotation3D& rotation);
/// @return no rotation for a quaternion that is none, such as that of a message that nobody filled in.
[[nodiscard]] idl::Rotation3D to_rotation(const geometry_msgs::Quaternion& quaternion);
[[nodiscard]] geometry_msgs::Pose to_ros_pose(const idl::Point& position, const idl::Rotation3D& rotation);
[[nodiscard]] geometry_msgs::Pose to_ros_pose(const Pose2& pose);
[[nodiscard]] Pose2 to_plane(const geometry_msgs::Pose& pose);
[[nodiscard]] geometry_msgs::Transform to_transform(const geometry_msgs::Pose& pose);

/// Puts the covariance of x, y and a heading in its place in that of six coordinates, and takes it from there.
[[nodiscard]] std::array<double, 36> to_six(const std::array<double, 9>& plane);
[[nodiscard]] std::array<double, 9> from_six(const std::array<double, 36>& six);

}  // namespace orca::ros
