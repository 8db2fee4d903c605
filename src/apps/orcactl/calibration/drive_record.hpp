// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/geometry/objects/waiting_scans.hpp"
#include "orca/navigation/odometry_calibration.hpp"

namespace orca::orcactl {

/// A goal that the robot has reached.
struct Reached {
  std::string name;
  TimePoint at;
};

/// A drive as it was recorded: what odometry counted, what the laser saw, and which goals were reached.
///
/// Thread contract: constant; any thread.
class DriveRecord {
 public:
  /// Reads a recording, an MCAP file or a CARMEN log.
  /// @param ports  of which one has odometry and one scans; empty: all of the recording, the first of each kind.
  /// @errors  as RecordedRun::open(); not_found if there is no odometry, or no scan, or no such port.
  [[nodiscard]] static Result<DriveRecord> read(const std::string& path, const std::set<std::string>& ports);

  /// Returns sentences about what is wrong in the recording.
  [[nodiscard]] const std::vector<std::string>& flaws() const { return flaws_; }
  [[nodiscard]] const nav::CountHistory& counts() const { return counts_; }
  [[nodiscard]] const std::vector<ScanPtr>& scans() const { return scans_; }
  [[nodiscard]] const std::vector<Reached>& goals() const { return goals_; }

 private:
  std::vector<std::string> flaws_;
  nav::CountHistory counts_;
  std::vector<ScanPtr> scans_;
  std::vector<Reached> goals_;
};

/// A drive as scans laid upon each other show it.
struct TrueDrive {
  struct Place {
    TimePoint at;
    nav::Counted counted;
    Pose2 X_MB;  ///< Of the base in the map.
  };
  std::vector<Place> places;  ///< In the order of time.

  /// Returns where the base was: from the place before, or else the first, as its odometry counts; nothing while that counts nothing.
  [[nodiscard]] std::optional<Pose2> at(TimePoint time, const nav::CountHistory& counts) const;
  [[nodiscard]] std::vector<nav::DrivenPiece> pieces() const;
};

/// Makes a map of a drive.
/// @param corrected  odometry is corrected by it first, since a map is the better, the better its odometry is.
[[nodiscard]] TrueDrive true_drive(const DriveRecord& record, const nav::OdometryCalibration& corrected);

}  // namespace orca::orcactl
