// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"

namespace orca::carmen {

/// The odometry of a base: a line ODOM. A plain value.
struct OdometryLine {
  Pose2 X_OB;              ///< Of the base in the frame of its odometry.
  double speed = 0.0;      ///< [m/s] forward.
  double turn_rate = 0.0;  ///< [rad/s] positive to the left.
};

/// The lasers that such logs tell apart.
enum class Laser { front, rear };

/// A scan: a line FLASER or RLASER, ROBOTLASER1 or ROBOTLASER2. A plain value.
struct ScanLine {
  Laser laser = Laser::front;
  double angle_start = 0.0;  ///< [rad] of the first reading in the frame of the laser, positive to the left.
  double angle_increment = 0.0;       ///< [rad] from one reading to the next.
  std::optional<double> max_range{};  ///< [m] at which there was no echo; nothing: the line does not say it.
  std::vector<double> ranges{};       ///< [m] NaN: there is no such reading.
  Pose2 X_OL;                         ///< Of the laser. In a corrected log it is in the map.
  Pose2 X_OB;                         ///< Of the base in the frame of its odometry.
  double speed = 0.0;                 ///< [m/s] of the base, as far as the line says it.
  double turn_rate = 0.0;             ///< [rad/s] of the base, likewise.
};

/// A parameter of the robot: a line PARAM. A plain value.
struct ParamLine {
  std::string name;
  std::string value;  ///< One word or several.
};

/// A line of a kind that is not read here, such as SYNC, TRUEPOS or GPS. A plain value.
struct OtherLine {
  std::string kind;
};

/// A line with nothing in it, or with a comment.
struct NoLine {};

/// A line of a log. A plain value.
struct Line {
  Duration stamp{
      0};  ///< When it was sensed, by the clock of whoever wrote the log; 0 for lines without a stamp.
  std::variant<NoLine, OtherLine, ParamLine, OdometryLine, ScanLine> content;
  Duration logged{0};  ///< When it was written, by the last number of the line.
};

/// Reads a line, without its end.
/// @errors  data_loss with the reason: a number is missing, is none, or cannot be; or the line is of no kind at all.
/// @thread  pure function; any thread.
/// @source  the comments at the beginning of CARMEN's own logs, and what programs that read these take the fields of ROBOTLASER1 for.
[[nodiscard]] Result<Line> read_line(std::string_view text);

/// Returns the line with its end. Places and stamps have 6 decimals, ranges 3, angles of beams 9.
/// A scan of 180 degrees is a FLASER or RLASER, any other a ROBOTLASER1 or ROBOTLASER2.
/// @thread  pure function; any thread.
[[nodiscard]] std::string to_text(const Line& line);

/// The columns of a table of scans: a text whose first line names them, as
/// `# t odom_x odom_y odom_theta ref_x ref_y ref_theta r0..rN-1`. The last of them stands for all readings.
///
/// Thread contract: a plain value.
class ScanTable {
 public:
  /// Returns the columns that the line names; nothing, if it does not begin a table: `t`, the three of `odom` and the readings must be there.
  [[nodiscard]] static std::optional<ScanTable> begins_with(std::string_view line);
  /// Reads a row. Its readings are taken for those of a front laser at the middle of the base.
  /// @errors  as carmen::read_line().
  [[nodiscard]] Result<Line> read_row(std::string_view text) const;

 private:
  ScanTable() = default;
  std::size_t t_ = 0, x_ = 0, y_ = 0, yaw_ = 0, readings_ = 0;  // columns
};

}  // namespace orca::carmen
