// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/idl/object.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/recording/carmen/line.hpp"
#include "orca/recording/objects/object_writer.hpp"
#include "orca/recording/output.hpp"

namespace orca::recording {

/// The text of a log of CARMEN, which many programs that make maps read, object by object.
///
/// Thread contract: not synchronised.
class CarmenText {
 public:
  /// Returns what the log begins with.
  [[nodiscard]] static std::string beginning();

  /// Returns the lines for an object: ODOM for an Odometry, a scan for LaserRangeReadings. Other objects have none, nor has a scan
  /// before the first odometry, because its line says where the robot is. That is where odometry had it at the stamp of the scan, on an arc between the
  /// odometry before and after. So a scan that is newer than all odometry waits for the next one, and comes with it, before it.
  /// With the first scan comes a parameter, the laser's largest range.
  /// @param row  of the object. Odometry is that of one row, and scans are those of one; objects of other rows are left out. A laser that two servers offer is one.
  [[nodiscard]] std::string text_of(std::string_view row, const ObjectRef& object);

  /// Returns the lines that the log ends with: scans after which no odometry came; they have the last one. The last call but for check().
  [[nodiscard]] std::string ending();

  /// Returns how many objects have got a line.
  [[nodiscard]] std::uint64_t lines() const { return lines_; }

  /// @errors  not_found if there were no scans, or no odometry before them, since a log without scans is of no use to those who read such logs;
  ///          invalid_argument if there were several rows of odometry or of scans, since a log is of one base and one laser.
  [[nodiscard]] Status check() const;

 private:
  struct Place {
    Duration stamp;
    carmen::OdometryLine odometry;
  };
  struct Waiting {
    Duration stamp;
    Pose2 X_BL;
    carmen::ScanLine scan;  // with the odometry that was the last when it came
  };

  std::string odometry_text(std::string_view row, const idl::Odometry& odometry, Duration stamp);
  std::string scan_text(std::string_view row, const idl::LaserRangeReadings& scan, Duration stamp);
  std::string line_of(const Waiting& waiting);
  std::string lines_until(Duration stamp);
  [[nodiscard]] carmen::OdometryLine odometry_at(Duration stamp) const;

  std::string base_;             // row from which odometry is taken
  std::string laser_;            // row from which scans are taken
  carmen::ScanLine like_;        // its last scan, without readings
  Pose2 X_BL_;                   // its place
  std::string other_;            // another row of the same kind; empty: none
  std::deque<Place> places_;     // the last ones, by time
  std::deque<Waiting> waiting_;  // scans that are newer, as they came
  std::uint64_t lines_ = 0;
  std::size_t scans_ = 0;
  std::size_t early_ = 0;  // scans before the first odometry
};

/// A writer of objects into a log of CARMEN. What is neither odometry nor a scan is left out.
///
/// Thread contract: one thread at a time.
class CarmenWriter final : public ObjectSink {
 public:
  /// @param output  where to; see Output.
  explicit CarmenWriter(std::unique_ptr<Output> output) : output_(std::move(output)) {}

  Status begin(const Origin& origin) override;
  Status attach_graph(const std::string& /*graph*/) override { return ok(); }
  Status attach_json(const std::string& /*name*/, const std::string& /*text*/) override { return ok(); }
  Status add(std::string_view row, const ObjectRef& object, TimePoint passed) override;
  Status flush() override;
  /// Writes a comment `# lost: PORT NUMBER` for each port of which objects were lost.
  /// @errors  as CarmenText::check(), too.
  Status close(const std::map<std::string, std::uint64_t>& lost, const Values& more) override;
  [[nodiscard]] std::uint64_t messages() const override { return text_.lines(); }
  [[nodiscard]] std::uint64_t size() const override { return size_; }

 private:
  std::unique_ptr<Output> output_;
  CarmenText text_;
  std::string waiting_;  // for the disk
  std::uint64_t size_ = 0;
};

}  // namespace orca::recording
