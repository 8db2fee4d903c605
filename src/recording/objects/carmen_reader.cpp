// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/recording/objects/carmen_reader.hpp"

#include <utility>
#include <variant>

#include "orca/idl/object_type.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"

namespace orca::recording {
namespace {

using carmen::Entry;
using carmen::Laser;
using carmen::OdometryLine;
using carmen::ScanLine;

const std::string kBase = "base.OdometryPush";

const std::string& row_of(Laser laser) {
  static const std::string front = "laser.LaserRangeReadingsPush";
  static const std::string rear = "rear_laser.LaserRangeReadingsPush";
  return laser == Laser::front ? front : rear;
}

ObjectRef object_of(const OdometryLine& line, TimePoint sensed) {
  auto object = make_object<idl::Odometry>();
  object->x(line.X_OB.x);
  object->y(line.X_OB.y);
  object->steer_angle(line.X_OB.yaw);
  object->translational_velocity(line.speed);
  object->steering_velocity(line.turn_rate);
  object->stamp(to_time_value(sensed));
  return std::move(object).seal();
}

// Takes the readings out of the line.
ObjectRef object_of(ScanLine& line, TimePoint sensed, const Pose2& X_BL, double max_range) {
  auto object = make_object<idl::LaserRangeReadings>();
  object->ranges(std::exchange(line.ranges, {}));
  object->max_range(max_range);
  object->pose().position().x(X_BL.x);
  object->pose().position().y(X_BL.y);
  object->pose().rotation().yaw(X_BL.yaw);
  object->pose().stamp(to_time_value(sensed));
  object->stamp(to_time_value(sensed));
  object->angle_start(line.angle_start);
  object->angle_increment(line.angle_increment);
  return std::move(object).seal();
}

}  // namespace

Result<CarmenReader> CarmenReader::open(const std::string& path) {
  Result<carmen::Log> log = carmen::read_log_file(path);
  if (!log) return log.error();
  return CarmenReader(*std::move(log));
}

CarmenReader::CarmenReader(carmen::Log log) : log_(std::move(log)) {
  std::map<std::string, std::uint64_t> counts;
  for (const Entry& entry : log_.entries) {
    const auto* const scan = std::get_if<ScanLine>(&entry.what.content);
    ++counts[scan == nullptr ? kBase : row_of(scan->laser)];
    if (scan == nullptr) has_odometry_lines_ = true;
    if (scan == nullptr || mounts_.contains(scan->laser)) continue;
    mounts_[scan->laser] = carmen::mount_of(log_, scan->laser);
    max_ranges_[scan->laser] = carmen::max_range_of(log_, scan->laser);
  }
  if (!has_odometry_lines_) counts[kBase] = log_.entries.size();
  for (const auto& [name, count] : counts) {
    const ObjectType& type =
        name == kBase ? object_type<idl::Odometry>() : object_type<idl::LaserRangeReadings>();
    rows_[name] = {name, {{std::string(type.name), count}}};
  }
}

void CarmenReader::take_objects(const std::function<void(const RecordedObject&)>& take) {
  for (Entry& entry : log_.entries) {
    const TimePoint sensed(entry.sensed);
    const TimePoint passed(entry.passed);
    auto* const scan = std::get_if<ScanLine>(&entry.what.content);
    OdometryLine place;
    if (scan == nullptr) place = std::get<OdometryLine>(entry.what.content);
    if (scan != nullptr) place = {scan->X_OB, scan->speed, scan->turn_rate};
    if (scan == nullptr || !has_odometry_lines_) take({kBase, object_of(place, sensed), passed});
    if (scan == nullptr) continue;
    const double max_range = scan->max_range.value_or(max_ranges_.at(scan->laser));
    take({row_of(scan->laser), object_of(*scan, sensed, mounts_.at(scan->laser), max_range), passed});
  }
}

}  // namespace orca::recording
