// SPDX-License-Identifier: LGPL-3.0-or-later
// Twins of what sensors say.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "convert.hpp"
#include "orca/base/portable_math.hpp"
#include "orca/geometry/angle.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "twin_making.hpp"

namespace orca::ros {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr std::uint8_t kUltrasound = 0;
constexpr std::uint8_t kInfrared = 1;

// In the order of idl::ImageEncoding.
constexpr std::array<std::string_view, 7> kEncodings{"mono8", "mono16",      "rgb8", "bgr8",
                                                     "rgba8", "bayer_rggb8", "16UC1"};
constexpr std::array<std::uint32_t, 7> kBytesPerPixel{1, 2, 3, 3, 4, 1, 2};

// REP 117: what was not heard is infinitely far, what is too near is minus infinity.
float to_ros_range(double range, double min_range, double max_range) {
  if (range >= max_range) return static_cast<float>(kInfinity);
  if (range < min_range) return static_cast<float>(-kInfinity);
  return static_cast<float>(range);
}

// Many lasers report 0 or NaN where nothing came back, which REP 117 calls +inf.
double from_ros_range(float range, double min_range, double max_range) {
  if (std::isnan(range) || range == 0.0F || range >= max_range) return max_range;
  return range < min_range ? 0.5 * min_range : static_cast<double>(range);
}

void mount(idl::RangeReadings& readings, const std_msgs::Header& header, const MountOf& mount_of) {
  const std::optional<idl::Frame3D> known = mount_of ? mount_of(header.frame_id) : std::nullopt;
  const idl::Frame3D place = known.value_or(idl::Frame3D{});
  readings.pose().position(place.position());
  readings.pose().rotation(place.rotation());
  readings.pose().stamp(to_time_value(to_instant(header.stamp)));
}

// A laser of ROS that hangs upside down says its angles as it measures them; Orca's angles are those seen from above.
void turn_upright(idl::LaserRangeReadings& scan) {
  idl::Rotation3D& rotation = scan.pose().rotation();
  if (portable::cos(rotation.roll()) >= 0.0) return;
  rotation.roll(wrapped(rotation.roll() - std::numbers::pi));
  scan.angle_start(-scan.angle_start());
  scan.angle_increment(-scan.angle_increment());
}

// --- LaserScan --------------------------------------------------------------------------------------------

void to_ros(const idl::LaserRangeReadings& scan, TimePoint stamp,
            std::vector<sensor_msgs::LaserScan>& messages) {
  const std::size_t count = scan.ranges().size();
  const double steps = count == 0 ? 0.0 : static_cast<double>(count - 1);
  sensor_msgs::LaserScan message;
  message.header = make_header(stamp, sensor_frame(scan));
  message.angle_min = static_cast<float>(scan.angle_start());
  message.angle_max = static_cast<float>(scan.angle_start() + steps * scan.angle_increment());
  message.angle_increment = static_cast<float>(scan.angle_increment());
  message.time_increment = static_cast<float>(scan.time_increment());
  message.scan_time = static_cast<float>(steps * scan.time_increment());
  message.range_min = static_cast<float>(scan.min_range());
  message.range_max = static_cast<float>(scan.max_range());
  for (const double range : scan.ranges())
    message.ranges.push_back(to_ros_range(range, scan.min_range(), scan.max_range()));
  messages.push_back(std::move(message));
}

Status from_ros(const sensor_msgs::LaserScan& message, const MountOf& mount_of,
                idl::LaserRangeReadings& scan) {
  if (!std::isfinite(message.range_max) || !std::isfinite(message.range_min) ||
      !std::isfinite(message.angle_min) || !std::isfinite(message.angle_increment))
    return fail(Code::data_loss, "a LaserScan says angles or limits of ranges that are not numbers");
  scan.min_range(message.range_min);
  scan.max_range(message.range_max);
  scan.angle_start(message.angle_min);
  scan.angle_increment(message.angle_increment);
  scan.time_increment(std::isfinite(message.time_increment) ? message.time_increment : 0.0);
  for (const float range : message.ranges)
    scan.ranges().push_back(from_ros_range(range, message.range_min, message.range_max));
  mount(scan, message.header, mount_of);
  turn_upright(scan);
  scan.stamp(scan.pose().stamp());
  return ok();
}

// --- Range ------------------------------------------------------------------------------------------------

// A ring of n sensors is n messages.
template <class Ring>
void ring_to_ros(const Ring& ring, TimePoint stamp, std::uint8_t kind, double half_angle,
                 std::vector<sensor_msgs::Range>& messages) {
  for (std::size_t i = 0; i < ring.ranges().size(); ++i) {
    const bool dated = i < ring.stamps().size() && ring.stamps()[i].ns() != 0;
    sensor_msgs::Range message;
    message.header = make_header(dated ? to_time_point(ring.stamps()[i]) : stamp,
                                 sensor_frame(ring, i, ring.ranges().size()));
    message.radiation_type = kind;
    message.field_of_view = static_cast<float>(2.0 * half_angle);
    message.min_range = static_cast<float>(ring.min_range());
    message.max_range = static_cast<float>(ring.max_range());
    message.range = to_ros_range(ring.ranges()[i], ring.min_range(), ring.max_range());
    messages.push_back(std::move(message));
  }
}

void to_ros(const idl::SonarRangeReadings& ring, TimePoint stamp, std::vector<sensor_msgs::Range>& messages) {
  ring_to_ros(ring, stamp, kUltrasound, ring.half_lobe(), messages);
}

void to_ros(const idl::InfraredRangeReadings& ring, TimePoint stamp,
            std::vector<sensor_msgs::Range>& messages) {
  ring_to_ros(ring, stamp, kInfrared, ring.half_beam(), messages);
}

// A message is a ring of one.
template <class Ring>
Status range_to_ring(const sensor_msgs::Range& message, const MountOf& mount_of, Ring& ring) {
  if (!std::isfinite(message.max_range) || !std::isfinite(message.min_range))
    return fail(Code::data_loss, "a Range says limits that are not numbers");
  ring.min_range(message.min_range);
  ring.max_range(message.max_range);
  // 0 is the reading of a sensor that something touches, unlike a laser's.
  ring.ranges().push_back(message.range == 0.0F
                              ? 0.5 * message.min_range
                              : from_ros_range(message.range, message.min_range, message.max_range));
  mount(ring, message.header, mount_of);
  idl::Frame3D place;
  place.position(ring.pose().position());
  place.rotation(ring.pose().rotation());
  ring.poses().push_back(place);
  ring.stamps().push_back(ring.pose().stamp());
  return ok();
}

Status from_ros(const sensor_msgs::Range& message, const MountOf& mount_of, idl::SonarRangeReadings& ring) {
  ring.half_lobe(0.5 * message.field_of_view);
  return range_to_ring(message, mount_of, ring);
}

Status from_ros(const sensor_msgs::Range& message, const MountOf& mount_of,
                idl::InfraredRangeReadings& ring) {
  ring.half_beam(0.5 * message.field_of_view);
  return range_to_ring(message, mount_of, ring);
}

// --- Odometry, Image, BatteryState, JointState -----------------------------------------------------------

void to_ros(const idl::Odometry& odometry, TimePoint stamp, std::vector<nav_msgs::Odometry>& messages) {
  const std::string context = context_of(odometry);
  nav_msgs::Odometry message;
  message.header = make_header(stamp, context + "odom");
  message.child_frame_id = context + "base_link";
  message.pose = {to_ros_pose(plane_pose(odometry)), to_six(odometry.covariance())};
  message.twist.twist.linear = {odometry.translational_velocity(), odometry.sideways_velocity(), 0.0};
  message.twist.twist.angular.z = odometry.steering_velocity();
  messages.push_back(std::move(message));
}

Status from_ros(const nav_msgs::Odometry& message, const MountOf& /*mount_of*/, idl::Odometry& odometry) {
  const Pose2 pose = to_plane(message.pose.pose);
  const geometry_msgs::Twist& twist = message.twist.twist;
  for (const double number : {pose.x, pose.y, pose.yaw, twist.linear.x, twist.linear.y, twist.angular.z})
    if (!std::isfinite(number)) return fail(Code::data_loss, "an Odometry holds what is not a number");
  odometry.x(pose.x);
  odometry.y(pose.y);
  odometry.steer_angle(pose.yaw);
  odometry.translational_velocity(twist.linear.x);
  odometry.sideways_velocity(twist.linear.y);
  odometry.steering_velocity(twist.angular.z);
  odometry.covariance(from_six(message.pose.covariance));
  odometry.stamp(to_time_value(to_instant(message.header.stamp)));
  return ok();
}

void to_ros(const idl::Image& image, TimePoint stamp, std::vector<sensor_msgs::Image>& messages) {
  sensor_msgs::Image message;
  message.header = make_header(stamp, optical_frame(image));
  message.height = image.height();
  message.width = image.width();
  message.encoding = kEncodings[std::min<std::size_t>(image.encoding(), kEncodings.size() - 1)];
  message.is_bigendian = 0;
  message.step = image.step();
  message.data = image.data();
  messages.push_back(std::move(message));
}

Status from_ros(const sensor_msgs::Image& message, const MountOf& mount_of, idl::Image& image) {
  const auto* const encoding = std::find(kEncodings.begin(), kEncodings.end(), message.encoding);
  if (encoding == kEncodings.end())
    return fail(Code::data_loss,
                "an Image has the encoding '" + message.encoding + "', which Orca has no name for");
  const auto kind = static_cast<std::size_t>(encoding - kEncodings.begin());
  if (message.is_bigendian != 0 || message.step / kBytesPerPixel[kind] < message.width ||
      message.data.size() != std::size_t{message.step} * message.height)
    return fail(Code::data_loss,
                "an Image has " + std::to_string(message.data.size()) +
                    " bytes, rows that are too short, or high bytes first; expected step times "
                    "height, low bytes first");
  image.encoding(static_cast<idl::ImageEncoding>(kind));
  image.width(message.width);
  image.height(message.height);
  image.step(message.step);
  image.data(message.data);
  const std::optional<idl::Frame3D> place = mount_of ? mount_of(message.header.frame_id) : std::nullopt;
  if (place) {
    image.pose().position(place->position());
    image.pose().rotation(from_optical(place->rotation()));
  }
  image.pose().stamp(to_time_value(to_instant(message.header.stamp)));
  return ok();
}

void to_ros(const idl::Battery& battery, TimePoint stamp, std::vector<sensor_msgs::BatteryState>& messages) {
  constexpr std::uint8_t kCharging = 1;
  constexpr std::uint8_t kDischarging = 2;
  sensor_msgs::BatteryState message;
  message.header = make_header(stamp, context_of(battery) + "base_link");
  message.voltage = static_cast<float>(battery.voltage());
  message.temperature = static_cast<float>(battery.temperature());
  message.current = static_cast<float>(battery.current());
  message.charge = message.capacity = message.design_capacity = kUnknown;  // in Ah
  message.percentage = static_cast<float>(battery.charge());
  message.power_supply_status = battery.charging() ? kCharging : kDischarging;
  message.present = true;
  message.location = battery.name();
  messages.push_back(std::move(message));
}

Status from_ros(const sensor_msgs::BatteryState& message, const MountOf& /*mount_of*/,
                idl::Battery& battery) {
  constexpr std::uint8_t kCharging = 1;
  constexpr std::uint8_t kFull = 4;
  battery.name(message.location);
  battery.voltage(message.voltage);
  battery.temperature(message.temperature);
  battery.current(message.current);
  battery.charge(message.percentage);
  battery.charging(message.power_supply_status == kCharging || message.power_supply_status == kFull);
  battery.stamp(to_time_value(to_instant(message.header.stamp)));
  return ok();
}

void to_ros(const idl::TurretAngle& turret, TimePoint stamp, std::vector<sensor_msgs::JointState>& messages) {
  sensor_msgs::JointState message;
  message.header = make_header(stamp, "");
  message.name = {context_of(turret) + "turret"};
  message.position = {turret.angle()};
  message.velocity = {turret.turn_rate()};
  messages.push_back(std::move(message));
}

}  // namespace

void add_sensing_twins(std::vector<Twin>& twins) {
  using enum TwinUse;
  twins.push_back(make_twin<idl::LaserRangeReadings, sensor_msgs::LaserScan, to_ros, from_ros>(shown));
  twins.push_back(make_twin<idl::SonarRangeReadings, sensor_msgs::Range, to_ros, from_ros>(plain));
  twins.push_back(make_twin<idl::InfraredRangeReadings, sensor_msgs::Range, to_ros, from_ros>(plain));
  twins.push_back(make_twin<idl::Odometry, nav_msgs::Odometry, to_ros, from_ros>(shown));
  twins.push_back(make_twin<idl::Image, sensor_msgs::Image, to_ros, from_ros>(shown));
  twins.push_back(make_twin<idl::Battery, sensor_msgs::BatteryState, to_ros, from_ros>(shown));
  twins.push_back(make_twin<idl::TurretAngle, sensor_msgs::JointState, to_ros, nullptr>(plain));
}

}  // namespace orca::ros
