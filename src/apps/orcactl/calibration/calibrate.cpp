// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "calibration/calibrate.hpp"

#include <cmath>
#include <cstdio>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "asking.hpp"
#include "calibration/drive_record.hpp"
#include "orca/base/portable_math.hpp"
#include "orca/robot_file/reader.hpp"
#include "orca/xml/extras.hpp"
#include "orca/xml/values.hpp"
#include "table.hpp"

namespace orca::orcactl {
namespace {

using supervisor::Record;

constexpr int kMaps = 2;  // the second one is made with the odometry that the first one has corrected

// Returns the track of a differential base, as its file says.
Result<double> track_of(const std::string& path) {
  xml::Diagnostics diagnostics;
  const Result<std::string> bytes = xml::read_bytes(path);
  const auto document = bytes ? xml::read_text(xml::without_extras(*bytes), path, diagnostics)
                              : xml::read_file(path, diagnostics);
  xml::Reporter reporter(diagnostics);
  robot_file::Devices devices;
  if (document && !diagnostics.has_errors())
    (void)robot_file::read_devices(document->root, devices, reporter);
  if (diagnostics.has_errors()) return fail(Code::invalid_argument, diagnostics.text());
  if (devices.fixed || devices.drive.kind != robot_file::DriveKind::differential)
    return fail(Code::invalid_argument, "it is not the file of a base with two driven wheels", path);
  return devices.drive.track;
}

std::string number(const char* format, double value) {
  char digits[64];
  std::snprintf(digits, sizeof digits, format, value);
  return digits;
}

Record row(const char* figure, const std::string& unit, double value, double deviation) {
  return {{"figure", figure},
          {"value", number("%.5f", value)},
          {"deviation", number("%.5f", deviation)},
          {"unit", unit}};
}

// The lines that go into a graph and into the robot's file. Standard deviations have two digits.
std::string lines_of(const nav::OdometryCalibration& found) {
  const auto param = [](const char* name, double value) {
    return "  <param name=\"" + std::string(name) + "\" value=\"" + number("%.5f", value) + "\"/>\n";
  };
  return "\nparameters of the driver in the graph, if they were 1, 1 and 0 in the recording:\n" +
         param("distance_scale", found.distance_scale.value) + param("turn_scale", found.turn_scale.value) +
         param("turn_per_metre", found.turn_per_metre.value) +
         "\nthe uncertainty that is left then, in the robot's file:\n" + "  <wheel_errors wheel_diameter=\"" +
         number("%.2g", 100.0 * found.left.diameter) + " %\" track=\"" +
         number("%.2g", 100.0 * found.left.track) + " %\" slip=\"" +
         number("%.2g", 1000.0 * found.left.slip) + " mm\" turn_slip=\"" +
         number("%.2g", 1000.0 * found.left.turn_slip) + " mm\"/>\n";
}

// Returns a frame at a place, whose x axis leads to another.
Pose2 frame_at(const Pose2& here, const Pose2& there) {
  const Vec2 way = there.position() - here.position();
  return {here.x, here.y, portable::atan2(way.y, way.x)};
}

// Returns where a square ends by something, seen from where it begins.
// @param at  tells the pose at a time.
template <class At>
std::optional<Vec2> end_by(const At& at, const Reached& begin, const Reached& on_first_leg,
                           const Reached& end) {
  const std::optional<Pose2> first = at(begin.at);
  const std::optional<Pose2> way = at(on_first_leg.at);
  const std::optional<Pose2> last = at(end.at);
  if (!first || !way || !last) return std::nullopt;
  return seen_from(frame_at(*first, *way), last->position());
}

// Returns the ends of the squares: each begins where a goal was reached, has one "start..." on its first leg, and ends at "cw..." or "ccw...".
std::vector<nav::SquareEnd> ends_of(const DriveRecord& record, const TrueDrive& drive) {
  const auto truly = [&](TimePoint time) { return drive.at(time, record.counts()); };
  const auto counted = [&](TimePoint time) -> std::optional<Pose2> {
    const auto at = record.counts().at(time);
    return at ? std::optional(at->X_OB) : std::nullopt;
  };
  std::vector<nav::SquareEnd> ends;
  const std::vector<Reached>& goals = record.goals();
  for (std::size_t i = 2; i < goals.size(); ++i) {
    const bool clockwise = goals[i].name.starts_with("cw");
    if (!goals[i - 1].name.starts_with("start") || !(clockwise || goals[i].name.starts_with("ccw"))) continue;
    const auto real = end_by(truly, goals[i - 2], goals[i - 1], goals[i]);
    const auto by_wheels = end_by(counted, goals[i - 2], goals[i - 1], goals[i]);
    if (real && by_wheels) ends.push_back({clockwise, *real - *by_wheels});
  }
  return ends;
}

Result<std::vector<Record>> squares_of(const DriveRecord& record, const TrueDrive& drive, double side,
                                       double track) {
  const std::vector<nav::SquareEnd> ends = ends_of(record, drive);
  const auto result = nav::evaluate_squares(ends, side, track);
  if (!result)
    return fail(
        Code::not_found,
        "there are no squares both ways round in the recording; each has a goal on its first leg whose name "
        "begins "
        "with start, and one at its end whose name begins with cw or ccw, as in graphs/calibrate.xml");
  const auto place = [](const char* figure, const Vec2& at) {
    return Record{
        {"figure", figure}, {"value", number("%.3f", at.x) + " " + number("%.3f", at.y)}, {"unit", "m"}};
  };
  return std::vector<Record>{
      {{"figure", "squares"}, {"value", std::to_string(ends.size())}, {"unit", ""}},
      place("clockwise", result->clockwise),
      place("counterclockwise", result->counterclockwise),
      {{"figure", "error"}, {"value", number("%.3f", result->error)}, {"unit", "m"}},
      {{"figure", "wheel_ratio"}, {"value", number("%.5f", result->wheel_ratio)}, {"unit", ""}},
      {{"figure", "track_ratio"}, {"value", number("%.5f", result->track_ratio)}, {"unit", ""}}};
}

// The options of a call.
struct Wishes {
  double track = 0.0;  // [m]
  double side = 0.0;   // [m] of squares; 0: none
};

Result<Wishes> wishes_of(const apps::Call& call) {
  Wishes wishes;
  const std::optional<std::string> robot = call.text("--robot");
  if (!robot)
    return fail(
        Code::invalid_argument,
        "name the robot's file: --robot sim/robots/pioneer_2dx.urdf; it says how far its wheels are apart");
  const Result<double> track = track_of(*robot);
  if (!track) return track.error();
  wishes.track = *track;
  const std::optional<std::string> square = call.text("--square");
  if (!square) return wishes;
  constexpr xml::ValueRule kSide{.form = xml::ValueRule::Form::number, .unit = "m", .min = 0.5, .max = 100.0};
  xml::ValueFault fault;
  const std::optional<double> side = xml::read_number(*square, kSide, fault);
  if (!side) return fail(Code::invalid_argument, "--square: " + fault.message);
  wishes.side = *side;
  return wishes;
}

Result<std::string> answer(const apps::Call& call, const Wishes& wishes) {
  const Result<DriveRecord> record =
      DriveRecord::read(call.words.front(), {call.words.begin() + 1, call.words.end()});
  if (!record) return record.error();
  for (const std::string& flaw : record->flaws())
    std::fprintf(stderr, "orcactl: %s: %s\n", call.words.front().c_str(), flaw.c_str());
  nav::OdometryCalibration found;
  TrueDrive drive;
  for (int map = 0; map < kMaps; ++map) {
    drive = true_drive(*record, found);
    Result<nav::OdometryCalibration> better = nav::calibrate(drive.pieces(), wishes.track);
    if (!better) return better.error();
    found = *better;
  }
  std::vector<Record> rows{
      row("distance_scale", "", found.distance_scale.value, found.distance_scale.deviation),
      row("turn_scale", "", found.turn_scale.value, found.turn_scale.deviation),
      row("turn_per_metre", "rad/m", found.turn_per_metre.value, found.turn_per_metre.deviation),
      row("wheel_ratio", "", found.wheel_ratio(wishes.track), wishes.track * found.turn_per_metre.deviation),
      row("track_ratio", "", found.track_ratio(), found.turn_scale.deviation)};
  std::vector<Record> squares;
  if (wishes.side > 0.0) {
    Result<std::vector<Record>> ends = squares_of(*record, drive, wishes.side, wishes.track);
    if (!ends) return ends.error();
    squares = *std::move(ends);
  }
  if (call.has("--json")) {
    rows.insert(rows.end(), squares.begin(), squares.end());
    return table_json(rows);
  }
  std::string text = table_text(rows, terminal_columns());
  if (!squares.empty()) text += "\n" + table_text(squares, terminal_columns());
  return text + lines_of(found);
}

}  // namespace

ExitCode calibrate(const apps::Call& call) {
  const Result<Wishes> wishes = wishes_of(call);
  if (!wishes) return report({wishes.error(), ExitCode::usage});
  const Result<std::string> text = answer(call, *wishes);
  if (!text) return report({text.error()});
  print(*text);
  return ExitCode::done;
}

}  // namespace orca::orcactl
