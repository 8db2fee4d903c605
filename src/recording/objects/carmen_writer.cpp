// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/recording/objects/carmen_writer.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/idl/sensing.hpp"

namespace orca::recording {
namespace {

constexpr std::size_t kPiece = std::size_t{64} << 10;  // [bytes] that are written at once

}  // namespace

std::string CarmenText::beginning() {
  return "# CARMEN Logfile, written by Orca\n"
         "# PARAM name value\n"
         "# ODOM x y theta tv rv accel\n"
         "# FLASER num_readings [range_readings] x y theta odom_x odom_y odom_theta\n"
         "# ROBOTLASER1 laser_type start_angle field_of_view angular_resolution maximum_range accuracy "
         "remission_mode\n"
         "#   num_readings [range_readings] num_remissions [remission_values] laser_pose_x laser_pose_y "
         "laser_pose_theta\n"
         "#   robot_pose_x robot_pose_y robot_pose_theta laser_tv laser_rv forward_safety_dist "
         "side_safety_dist turn_axis\n"
         "# each line ends with: ipc_timestamp ipc_hostname logger_timestamp\n";
}

std::string CarmenText::text_of(std::string_view row, const ObjectRef& object) {
  const Duration stamp = object.stamp().time_since_epoch();
  if (const auto odometry = object_cast<idl::Odometry>(object)) return odometry_text(row, *odometry, stamp);
  const auto scan = object_cast<idl::LaserRangeReadings>(object);
  return scan ? scan_text(row, *scan, stamp) : "";
}

std::string CarmenText::odometry_text(std::string_view row, const idl::Odometry& odometry, Duration stamp) {
  if (base_.empty()) base_ = row;
  if (base_ != row) return other_ = row, "";
  place_ = carmen::OdometryLine{{odometry.x(), odometry.y(), odometry.steer_angle()},
                                odometry.translational_velocity(),
                                odometry.steering_velocity()};
  return to_text(carmen::Line{stamp, *place_});
}

std::string CarmenText::scan_text(std::string_view row, const idl::LaserRangeReadings& scan, Duration stamp) {
  const Pose2 X_BL{scan.pose().position().x(), scan.pose().position().y(), scan.pose().rotation().yaw()};
  carmen::ScanLine line;
  line.angle_start = scan.angle_start();
  line.angle_increment = scan.angle_increment();
  line.max_range = scan.max_range();
  if (!laser_.empty() && laser_ != row) {
    const bool is_same = X_BL == X_BL_ && line.angle_start == like_.angle_start &&
                         line.angle_increment == like_.angle_increment && line.max_range == like_.max_range;
    if (!is_same) other_ = row;
    return "";
  }
  laser_ = row;
  like_ = line;
  X_BL_ = X_BL;
  if (!place_) return ++early_, "";
  line.ranges.assign(scan.ranges().begin(), scan.ranges().end());
  line.X_OL = place_->X_OB * X_BL;
  line.X_OB = place_->X_OB;
  line.speed = place_->speed;
  line.turn_rate = place_->turn_rate;
  std::string text;
  if (scans_++ == 0)
    text = to_text(
        carmen::Line{{}, carmen::ParamLine{"robot_front_laser_max", std::to_string(scan.max_range())}});
  return text + to_text(carmen::Line{stamp, line});
}

Status CarmenText::check() const {
  if (!other_.empty())
    return fail(Code::invalid_argument,
                "a CARMEN log is of one base and one laser, and there are several; it has " +
                    in_quotes(base_) + " and " + in_quotes(laser_) + ", and nothing of " + in_quotes(other_) +
                    "; name the ports that are meant");
  if (scans_ > 0) return ok();
  return fail(Code::not_found,
              early_ > 0 ? "there is no odometry before the scans; record the port of the base as well"
                         : "there are no scans of a laser in the recording");
}

Status CarmenWriter::begin(const Origin& /*origin*/) {
  waiting_ = CarmenText::beginning();
  return ok();
}

Status CarmenWriter::add(std::string_view row, const ObjectRef& object, TimePoint /*passed*/) {
  const std::string text = text_.text_of(row, object);
  if (text.empty()) return ok();
  ++lines_;
  waiting_ += text;
  return waiting_.size() < kPiece ? ok() : flush();
}

Status CarmenWriter::flush() {
  if (waiting_.empty()) return ok();
  const auto bytes = std::as_bytes(std::span(waiting_));
  size_ += bytes.size();
  Status written = output_->append({bytes.begin(), bytes.end()});
  waiting_.clear();
  return written;
}

Status CarmenWriter::close(const std::map<std::string, std::uint64_t>& /*lost*/, const Values& /*more*/) {
  const Status written = flush();
  const Status finished = output_->finish();
  if (!written.ok()) return written;
  return finished.ok() ? text_.check() : finished;
}

}  // namespace orca::recording
