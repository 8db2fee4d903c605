// SPDX-License-Identifier: LGPL-3.0-or-later
// Twins of what robots are told, where they are and go, and of what people read.
#include <algorithm>
#include <cmath>
#include <utility>

#include "convert.hpp"
#include "orca/base/portable_math.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/generated/system.reflection.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"
#include "twin_making.hpp"

namespace orca::ros {
namespace {

// Where a command says a direction, a Twist turns there in about this time [s], at most at that rate [rad/s]: what a
// MotionCommandFuser does unless it is told otherwise.
constexpr double kTimeToTurn = 1.0;
constexpr double kFastestTurn = 1.0;
// How exactly a PoseStamped is to be reached, which it does not say.
constexpr double kReachRadius = 0.25;  // [m]
constexpr double kReachAngle = 0.25;   // [rad]

Status not_numbers(const char* message) {
  return fail(Code::data_loss, std::string(message) + " holds what is not a number");
}

bool is_finite(const geometry_msgs::Pose& pose) {
  const auto& [x, y, z, w] = pose.orientation;
  return std::isfinite(pose.position.x + pose.position.y + pose.position.z) && std::isfinite(x + y + z + w);
}

// Places are in the frame of the map: nobody here turns them from another one.
Status check_map(const std_msgs::Header& header, const char* message) {
  const std::string& frame = header.frame_id;
  if (frame.empty() || frame == "map" || frame.ends_with("/map")) return ok();
  return fail(Code::data_loss,
              std::string(message) + " is in the frame '" + frame + "'; only places in 'map' are understood");
}

// --- Twist ------------------------------------------------------------------------------------------------

// A command without an opinion is no message.
void to_ros(const idl::MotionCommand& command, TimePoint /*stamp*/,
            std::vector<geometry_msgs::Twist>& messages) {
  geometry_msgs::Twist twist;
  if (command.kind() == idl::DONTCARE) return;
  if (command.kind() == idl::NORMAL) {
    const bool by_rate = command.steering() == idl::BY_TURN_RATE;
    const double ahead = by_rate ? 1.0 : std::max(0.0, portable::cos(command.direction()));
    twist.linear.x = ahead * command.speed();
    twist.angular.z = by_rate ? command.turn_rate()
                              : std::clamp(command.direction() / kTimeToTurn, -kFastestTurn, kFastestTurn);
  }
  messages.push_back(twist);
}

void to_ros(const idl::HolonomicVelocity& velocity, TimePoint stamp,
            std::vector<geometry_msgs::Twist>& messages) {
  to_ros(static_cast<const idl::MotionCommand&>(velocity), stamp, messages);
  if (velocity.kind() == idl::NORMAL) messages.back().linear.y = velocity.left();
}

template <class Command>
void to_stamped(const Command& command, TimePoint stamp, std::vector<geometry_msgs::TwistStamped>& messages) {
  std::vector<geometry_msgs::Twist> twists;
  to_ros(command, stamp, twists);
  for (const geometry_msgs::Twist& twist : twists)
    messages.push_back({make_header(stamp, context_of(command) + "base_link"), twist});
}

void to_ros(const idl::MotionCommand& command, TimePoint stamp,
            std::vector<geometry_msgs::TwistStamped>& messages) {
  to_stamped(command, stamp, messages);
}

void to_ros(const idl::HolonomicVelocity& velocity, TimePoint stamp,
            std::vector<geometry_msgs::TwistStamped>& messages) {
  to_stamped(velocity, stamp, messages);
}

// A Twist that asks for a sideways speed is a HolonomicVelocity, which bases that cannot move so refuse.
Result<ObjectRef> to_command(const geometry_msgs::Twist& twist, TimePoint stamp, const std::string& frame) {
  for (const double number : {twist.linear.x, twist.linear.y, twist.angular.z})
    if (!std::isfinite(number)) return not_numbers("a Twist").error();
  const auto finish = [&](auto command) {
    command->creation_time(to_time_value(stamp));
    command->origin(frame);
    return std::move(command).seal().ref();
  };
  if (twist.linear.y == 0.0) return finish(turn(twist.angular.z, twist.linear.x));
  return finish(slide(twist.linear.x, twist.linear.y, twist.angular.z));
}

Result<ObjectRef> twist_to_command(std::span<const std::byte> payload, const MountOf& /*mount_of*/,
                                   TimePoint came) {
  geometry_msgs::Twist twist;
  if (Status read = from_cdr(payload, twist); !read.ok()) return read.error();
  return to_command(twist, came, {});
}

Result<ObjectRef> stamped_to_command(std::span<const std::byte> payload, const MountOf& /*mount_of*/,
                                     TimePoint came) {
  geometry_msgs::TwistStamped message;
  if (Status read = from_cdr(payload, message); !read.ok()) return read.error();
  return to_command(message.twist, came, message.header.frame_id);
}

// --- Poses, paths, maps -----------------------------------------------------------------------------------

void to_ros(const idl::RobotPose& pose, TimePoint stamp,
            std::vector<geometry_msgs::PoseWithCovarianceStamped>& messages) {
  messages.push_back({make_header(stamp, "map"), {to_ros_pose(plane_pose(pose)), to_six(pose.covariance())}});
}

Status from_ros(const geometry_msgs::PoseWithCovarianceStamped& message, const MountOf& /*mount_of*/,
                idl::RobotPose& pose) {
  if (Status known = check_map(message.header, "a PoseWithCovarianceStamped"); !known.ok()) return known;
  const Pose2 X_WR = to_plane(message.pose.pose);
  if (!is_finite(message.pose.pose)) return not_numbers("a PoseWithCovarianceStamped");
  pose.x(X_WR.x);
  pose.y(X_WR.y);
  pose.orientation(X_WR.yaw);
  pose.covariance(from_six(message.pose.covariance));
  pose.stamp(to_time_value(to_instant(message.header.stamp)));
  return ok();
}

void to_ros(const idl::GoalPoint& goal, TimePoint stamp, std::vector<geometry_msgs::PoseStamped>& messages) {
  const idl::Point& place = goal.coordinate().point();
  idl::Rotation3D rotation;
  if (goal.use_orientation()) rotation.yaw(goal.orientation().orientation().yaw());
  messages.push_back({make_header(stamp, "map"), to_ros_pose(place, rotation)});
}

Status from_ros(const geometry_msgs::PoseStamped& message, const MountOf& /*mount_of*/,
                idl::GoalPoint& goal) {
  if (Status known = check_map(message.header, "a PoseStamped"); !known.ok()) return known;
  const geometry_msgs::Point& place = message.pose.position;
  const idl::Rotation3D rotation = to_rotation(message.pose.orientation);
  if (!is_finite(message.pose)) return not_numbers("a PoseStamped");
  goal.name("goal");
  goal.coordinate().point(make_point(place.x, place.y, place.z));
  goal.reach_radius().distance(kReachRadius);
  goal.use_orientation(true);
  goal.orientation().orientation(rotation);
  goal.reach_angle(kReachAngle);
  return ok();
}

void to_ros(const idl::Path& path, TimePoint stamp, std::vector<nav_msgs::Path>& messages) {
  nav_msgs::Path message{make_header(stamp, "map"), {}};
  for (const idl::Pose3D& pose : path.poses())
    message.poses.push_back(
        {make_header(to_time_point(pose.stamp()), "map"), to_ros_pose(pose.position(), pose.rotation())});
  messages.push_back(std::move(message));
}

Status from_ros(const nav_msgs::Path& message, const MountOf& /*mount_of*/, idl::Path& path) {
  if (Status known = check_map(message.header, "a Path"); !known.ok()) return known;
  for (const geometry_msgs::PoseStamped& stamped : message.poses) {
    const geometry_msgs::Point& place = stamped.pose.position;
    idl::Pose3D pose;
    pose.position(make_point(place.x, place.y, place.z));
    pose.rotation(to_rotation(stamped.pose.orientation));
    pose.stamp(to_time_value(to_instant(stamped.header.stamp)));
    if (!is_finite(stamped.pose)) return not_numbers("a Path");
    path.poses().push_back(pose);
  }
  return ok();
}

// 255 is -1 there: not known.
void to_ros(const idl::OccupancyGrid& grid, TimePoint stamp, std::vector<nav_msgs::OccupancyGrid>& messages) {
  nav_msgs::OccupancyGrid message;
  message.header = make_header(stamp, "map");
  message.info = {to_ros_time(to_time_point(grid.corner().stamp())), static_cast<float>(grid.resolution()),
                  grid.columns(), grid.rows(), to_ros_pose(plane_pose(grid.corner()))};
  message.data.resize(grid.cells().size());
  std::copy(grid.cells().begin(), grid.cells().end(), message.data.begin());
  messages.push_back(std::move(message));
}

Status from_ros(const nav_msgs::OccupancyGrid& message, const MountOf& /*mount_of*/,
                idl::OccupancyGrid& grid) {
  if (Status known = check_map(message.header, "an OccupancyGrid"); !known.ok()) return known;
  const nav_msgs::MapMetaData& info = message.info;
  const Pose2 corner = to_plane(info.origin);
  if (!is_finite(info.origin) || !std::isfinite(info.resolution) || info.resolution <= 0.0F)
    return not_numbers("an OccupancyGrid");
  if (message.data.size() != std::size_t{info.width} * info.height)
    return fail(Code::data_loss, "an OccupancyGrid has " + std::to_string(message.data.size()) +
                                     " cells; expected width times height");
  grid.corner().x(corner.x);
  grid.corner().y(corner.y);
  grid.corner().orientation(corner.yaw);
  grid.corner().stamp(to_time_value(to_instant(info.map_load_time)));
  grid.resolution(info.resolution);
  grid.columns(info.width);
  grid.rows(info.height);
  for (const std::int8_t cell : message.data)
    grid.cells().push_back(cell < 0 || cell > 100 ? 255 : static_cast<std::uint8_t>(cell));
  return ok();
}

// --- What people read ------------------------------------------------------------------------------------

void to_ros(const idl::LogRecord& line, TimePoint stamp, std::vector<rcl_interfaces::Log>& messages) {
  rcl_interfaces::Log message;
  message.stamp = to_ros_time(stamp);
  message.level =
      static_cast<std::uint8_t>(10 * (static_cast<int>(line.level()) + 1));  // 10 debug to 40 error
  message.name = line.source();
  message.msg = line.text();
  messages.push_back(std::move(message));
}

void to_ros(const idl::Alarm& alarm, TimePoint stamp,
            std::vector<diagnostic_msgs::DiagnosticArray>& messages) {
  constexpr std::uint8_t kOk = 0;
  constexpr std::uint8_t kWarn = 1;
  constexpr std::uint8_t kError = 2;
  const std::string_view kind =
      alarm.kind() == idl::OWN_KIND
          ? std::string_view(alarm.own_kind())
          : EnumReflection<idl::AlarmKind>::names[static_cast<std::size_t>(alarm.kind())];
  diagnostic_msgs::DiagnosticStatus status;
  const std::uint8_t raised = alarm.severity() == idl::ALARM_CRITICAL ? kError : kWarn;
  status.level = alarm.active() ? raised : kOk;
  status.name = alarm.source() + ": " + std::string(kind);  // readers keep one status for each name
  status.message = alarm.text();
  status.hardware_id = alarm.source();
  status.values = {{"kind", std::string(kind)}, {"hook", alarm.hook()}};
  messages.push_back({make_header(stamp, ""), {std::move(status)}});
}

}  // namespace

void add_acting_twins(std::vector<Twin>& twins) {
  using enum TwinUse;
  twins.push_back(make_twin<idl::HolonomicVelocity, geometry_msgs::Twist, to_ros, nullptr>(plain));
  twins.push_back(make_twin<idl::HolonomicVelocity, geometry_msgs::TwistStamped, to_ros, nullptr>(plain));
  twins.push_back(make_twin<idl::MotionCommand, geometry_msgs::Twist, to_ros, nullptr>(plain));
  twins.back().from_ros = twist_to_command;
  twins.push_back(make_twin<idl::MotionCommand, geometry_msgs::TwistStamped, to_ros, nullptr>(plain));
  twins.back().from_ros = stamped_to_command;
  twins.push_back(
      make_twin<idl::RobotPose, geometry_msgs::PoseWithCovarianceStamped, to_ros, from_ros>(shown));
  twins.push_back(make_twin<idl::GoalPoint, geometry_msgs::PoseStamped, to_ros, from_ros>(shown));
  twins.push_back(make_twin<idl::Path, nav_msgs::Path, to_ros, from_ros>(shown));
  twins.push_back(make_twin<idl::OccupancyGrid, nav_msgs::OccupancyGrid, to_ros, from_ros>(latched));
  twins.push_back(make_twin<idl::LogRecord, rcl_interfaces::Log, to_ros, nullptr>(latched));
  twins.push_back(make_twin<idl::Alarm, diagnostic_msgs::DiagnosticArray, to_ros, nullptr>(plain));
}

}  // namespace orca::ros
