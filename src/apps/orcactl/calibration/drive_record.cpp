// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "calibration/drive_record.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/geometry/arc.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/navigation/beams.hpp"
#include "orca/navigation/slam.hpp"
#include "orca/recording/objects/recorded_run.hpp"
#include "orca/xml/names.hpp"

namespace orca::orcactl {
namespace {

using recording::RecordedObject;
using recording::RecordedRun;

constexpr double kFarthest = 20.0;  // [m] echoes that count

Status check_ports(const RecordedRun& run, const std::set<std::string>& ports) {
  std::vector<std::string> known;
  for (const auto& [name, row] : run.rows()) known.push_back(name);
  for (const std::string& port : ports)
    if (!run.rows().contains(port))
      return fail(Code::not_found, "nothing of " + in_quotes(port) + " is in the recording" +
                                       xml::did_you_mean(xml::nearest_name(port, known)));
  return ok();
}

// Returns whether objects of this row are taken: of the first row that has objects of a kind.
bool takes(std::string& chosen, std::string_view row) {
  if (chosen.empty()) chosen = row;
  return chosen == row;
}

// The odometry of a base, corrected step by step.
class Corrected {
 public:
  explicit Corrected(const nav::OdometryCalibration& by) : by_(by) {}

  // Returns the pose after what was counted, from reading to reading.
  Pose2 go_to(const Pose2& X_OB) {
    if (last_) {
      const Travel2 step = arc_between(*last_, X_OB);
      const Travel2 real{by_.distance_scale.value * step.forward, by_.distance_scale.value * step.left,
                         by_.turn_scale.value * step.turn + by_.turn_per_metre.value * step.forward};
      pose_ = along_arc(pose_, real);
    } else {
      pose_ = X_OB;
    }
    last_ = X_OB;
    return pose_;
  }

 private:
  const nav::OdometryCalibration& by_;
  std::optional<Pose2> last_;
  Pose2 pose_;
};

// Returns the points of a scan in the frame that the robot had at its first beam.
std::vector<nav::SurfacePoint> surface_of(const idl::LaserRangeReadings& scan, const Pose2& first,
                                          const Pose2& last) {
  const Pose2 X_RS = plane_pose(scan.pose());
  std::vector<nav::Beam> beams;
  nav::beams_of({scan.ranges(), scan.min_range(), scan.max_range(), scan.angle_start(),
                 scan.angle_increment(), first * X_RS, last * X_RS},
                kFarthest, beams);
  std::vector<Vec2> points;
  for (const nav::Beam& beam : beams)
    if (beam.echo) points.push_back(seen_from(first, beam.to));
  return nav::surface_of(points, X_RS.position());
}

}  // namespace

Result<DriveRecord> DriveRecord::read(const std::string& path, const std::set<std::string>& ports) {
  const Result<std::unique_ptr<RecordedRun>> run = RecordedRun::open(path);
  if (!run) return run.error();
  if (Status known = check_ports(**run, ports); !known.ok()) return known.error();
  DriveRecord record;
  std::string base;
  std::string laser;
  const Status read = (*run)->take_objects({}, [&](const RecordedObject& one) {
    if (const auto arrived = object_cast<idl::Arrived>(one.object))
      record.goals_.push_back({arrived->name(), to_time_point(arrived->stamp())});
    if (!ports.empty() && !ports.contains(std::string(one.row))) return;
    if (const auto odometry = object_cast<idl::Odometry>(one.object); odometry && takes(base, one.row))
      record.counts_.add(to_time_point(odometry->stamp()), plane_pose(*odometry));
    if (auto scan = object_cast<idl::LaserRangeReadings>(one.object); scan && takes(laser, one.row))
      record.scans_.push_back(std::move(scan));
  });
  if (!read.ok()) return read.error();
  record.flaws_ = (*run)->flaws();
  if (base.empty() || laser.empty())
    return fail(Code::not_found,
                base.empty() ? "there is no odometry in the recording; record the port of the base as well"
                             : "there are no scans of a laser in the recording");
  return record;
}

std::optional<Pose2> TrueDrive::at(TimePoint time, const nav::CountHistory& counts) const {
  const auto next = std::ranges::upper_bound(places, time, {}, &Place::at);
  const auto counted = counts.at(time);
  if (places.empty() || !counted) return std::nullopt;
  const Place& before = next == places.begin() ? *next : *(next - 1);
  return before.X_MB * seen_from(before.counted.X_OB, counted->X_OB);
}

std::vector<nav::DrivenPiece> TrueDrive::pieces() const {
  std::vector<nav::DrivenPiece> pieces;
  for (std::size_t i = 1; i < places.size(); ++i)
    pieces.push_back(nav::piece_between(places[i - 1].counted, places[i].counted,
                                        seen_from(places[i - 1].X_MB, places[i].X_MB)));
  return pieces;
}

TrueDrive true_drive(const DriveRecord& record, const nav::OdometryCalibration& corrected) {
  nav::Slam slam;
  TrueDrive drive;
  Corrected odometry(corrected);
  for (const ScanPtr& scan : record.scans()) {
    const TimePoint stamp = to_time_point(scan->stamp());
    const auto first = record.counts().at(stamp);
    const auto last = record.counts().at(last_beam_of(*scan));
    if (!first || !last) continue;
    const auto points = surface_of(*scan, first->X_OB, last->X_OB);
    (void)slam.see(points, odometry.go_to(first->X_OB));
    if (slam.nodes().size() > drive.places.size()) drive.places.push_back({stamp, *first, {}});
  }
  for (std::size_t i = 0; i < drive.places.size(); ++i) drive.places[i].X_MB = slam.nodes()[i].X_MR;
  return drive;
}

}  // namespace orca::orcactl
