// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/recording/objects/carmen_writer.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/geometry/arc.hpp"
#include "orca/idl/sensing.hpp"

namespace orca::recording {
namespace {

constexpr std::size_t kPiece = std::size_t{64} << 10;  // [bytes] that are written at once
constexpr std::size_t kMostPlaces = 200;               // 2 s and more, far longer than a scan is on its way
constexpr std::size_t kMostWaiting = 20;               // scans; if more come, there is no odometry any more

void put(const carmen::OdometryLine& odometry, const Pose2& X_BL, carmen::ScanLine& scan) {
  scan.X_OL = odometry.X_OB * X_BL;
  scan.X_OB = odometry.X_OB;
  scan.speed = odometry.speed;
  scan.turn_rate = odometry.turn_rate;
}

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
  std::string text;
  if (!places_.empty() && stamp < places_.back().stamp) {  // its clock was set
    text = ending();
    places_.clear();
  }
  places_.push_back({stamp,
                     {{odometry.x(), odometry.y(), odometry.steer_angle()},
                      odometry.translational_velocity(),
                      odometry.steering_velocity()}});
  if (places_.size() > kMostPlaces) places_.pop_front();
  text += lines_until(stamp);
  ++lines_;
  return text + to_text(carmen::Line{stamp, places_.back().odometry});
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
  if (places_.empty()) return ++early_, "";
  line.ranges.assign(scan.ranges().begin(), scan.ranges().end());
  put(odometry_at(stamp), X_BL, line);
  Waiting one{stamp, X_BL, std::move(line)};
  if (stamp <= places_.back().stamp) return line_of(one);
  waiting_.push_back(std::move(one));
  if (waiting_.size() <= kMostWaiting) return "";
  const Waiting first = std::move(waiting_.front());
  waiting_.pop_front();
  return line_of(first);
}

std::string CarmenText::line_of(const Waiting& waiting) {
  std::string text;
  if (scans_++ == 0)
    text = to_text(carmen::Line{
        {},
        carmen::ParamLine{"robot_front_laser_max", std::to_string(waiting.scan.max_range.value_or(0.0))}});
  ++lines_;
  return text + to_text(carmen::Line{waiting.stamp, waiting.scan});
}

// Returns the lines of scans that have waited for odometry up to a stamp.
std::string CarmenText::lines_until(Duration stamp) {
  std::string text;
  for (; !waiting_.empty() && waiting_.front().stamp <= stamp; waiting_.pop_front()) {
    Waiting& one = waiting_.front();
    put(odometry_at(one.stamp), one.X_BL, one.scan);
    text += line_of(one);
  }
  return text;
}

// Returns what odometry was at a stamp, or what is nearest to it.
carmen::OdometryLine CarmenText::odometry_at(Duration stamp) const {
  const auto after = std::ranges::lower_bound(places_, stamp, {}, &Place::stamp);
  if (after == places_.end()) return places_.back().odometry;
  if (after == places_.begin() || after->stamp == stamp) return after->odometry;
  const auto& [before, from] = *std::prev(after);
  const carmen::OdometryLine& to = after->odometry;
  const double share = to_seconds(stamp - before) / to_seconds(after->stamp - before);
  const Travel2 way = arc_between(from.X_OB, to.X_OB);
  return {along_arc(from.X_OB, {share * way.forward, share * way.left, share * way.turn}),
          std::lerp(from.speed, to.speed, share), std::lerp(from.turn_rate, to.turn_rate, share)};
}

std::string CarmenText::ending() {
  std::string text;
  for (const Waiting& one : std::exchange(waiting_, {})) text += line_of(one);
  return text;
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

Status CarmenWriter::close(const std::map<std::string, std::uint64_t>& lost, const Values& /*more*/) {
  waiting_ += text_.ending();
  for (const auto& [port, count] : lost)
    if (count > 0) waiting_ += "# lost: " + port + " " + std::to_string(count) + "\n";
  const Status written = flush();
  const Status finished = output_->finish();
  if (!written.ok()) return written;
  return finished.ok() ? text_.check() : finished;
}

}  // namespace orca::recording
