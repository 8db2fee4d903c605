// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <string>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/idl/object.hpp"
#include "orca/recording/carmen/log.hpp"
#include "orca/recording/objects/object_reader.hpp"

namespace orca::recording {

/// A reader of the logs of CARMEN, which many laboratories have published, as objects: an Odometry for each line ODOM, or for each scan if there are
/// no such lines, and a LaserRangeReadings for each scan. Their rows have the names of the ports of a robot's own driver: `base.OdometryPush`,
/// `laser.LaserRangeReadingsPush`, and `rear_laser.LaserRangeReadingsPush`. Tables of scans (carmen::ScanTable) are read likewise.
///
/// How wrong odometry and ranges are, and how long the laser takes for a scan, is not known from such a log.
///
/// Thread contract: constant but for take_objects(); not synchronised.
class CarmenReader {
 public:
  /// @errors  as carmen::read_log_file().
  [[nodiscard]] static Result<CarmenReader> open(const std::string& path);

  [[nodiscard]] const std::map<std::string, RecordedRow>& rows() const { return rows_; }
  [[nodiscard]] const carmen::Log& log() const { return log_; }
  /// Returns when the first and the last of its entries passed, by the clock of whoever wrote the log.
  [[nodiscard]] TimePoint begin() const { return TimePoint(log_.entries.front().passed); }
  [[nodiscard]] TimePoint end() const { return TimePoint(log_.entries.back().passed); }

  /// Passes the objects on in the order of the log, and forgets the readings of each, since a log may fill a good part of the memory. The
  /// last call: objects that came after it would have no readings.
  void take_objects(const std::function<void(const RecordedObject&)>& take);

 private:
  explicit CarmenReader(carmen::Log log);

  carmen::Log log_;
  std::map<std::string, RecordedRow> rows_;
  bool has_odometry_lines_ = false;
  std::map<carmen::Laser, double> max_ranges_;
  std::map<carmen::Laser, Pose2> mounts_;
};

}  // namespace orca::recording
