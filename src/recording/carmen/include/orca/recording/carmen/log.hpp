// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/recording/carmen/line.hpp"

namespace orca::carmen {

/// Something that is wrong in a log, how often, and where first.
struct Flaw {
  std::size_t count = 0;
  std::size_t first_line = 0;  ///< Counted from 1.
  std::string first{};         ///< The first of them, for people.

  void note(std::size_t line, std::string_view text);
};

/// Unusual things in a log. They do not end the reading.
struct Flaws {
  Flaw damaged;  ///< Lines that cannot be read: they are left out.
  Flaw
      back;  ///< Stamps that are older than one before of the same device, by less than a second: they stay as they are.
  Flaw
      wrong;  ///< Stamps that are 0, or alone far off, as in logs that were corrected: such a line has the time of the one before.
  Flaw
      clock_jumps;  ///< Stamps that are older by more, or that come an hour or more later: the clock was set, and time goes on without that.
  Flaw gaps;  ///< Pauses of ten times the usual interval of odometry or of scans, and of a second at least.
  std::string stamps;  ///< What is odd about the stamps of all lines together; empty: nothing.
  std::string cut;     ///< Why the file ends before its end; empty: it does not.

  /// Returns one sentence for each kind that there is.
  [[nodiscard]] std::vector<std::string> texts() const;
};

/// A line of a log that a robot's device has sent, odometry or a scan, with its times.
struct Entry {
  std::size_t line = 0;  ///< Counted from 1.
  Line what;
  Duration sensed{0};  ///< By the stamps, but without jumps of the clock.
  Duration passed{0};  ///< The same, but never less than that of the entry before: when it comes again.
};

/// A log as it was read.
struct Log {
  std::vector<Entry> entries;                 ///< In the order of the file.
  std::map<std::string, std::string> params;  ///< Of lines PARAM; the last word counts.
  std::map<std::string, std::size_t>
      others;  ///< Kinds of lines that are not read, with how many there are of each.
  Flaws flaws;
};

/// The memory that a log may take [bytes]: about 130 million readings of a laser. A file that is packed can be a thousand times smaller.
constexpr std::size_t kMostOfLog = std::size_t{1} << 30;

/// Reads a log from pieces of text.
/// @param next  returns the next piece, which needs not end with a line; empty: there is none.
/// @param most  the memory that it may take [bytes].
/// @errors  data_loss if there is neither odometry nor a scan in it; invalid_argument if it takes more than `most`.
/// @thread  any.
[[nodiscard]] Result<Log> read_log(const std::function<std::string_view()>& next,
                                   std::size_t most = kMostOfLog);

/// Reads a log of CARMEN, or a table of scans (ScanTable), packed by gzip or not.
/// @errors  invalid_argument if it cannot be opened; as read_log(), with the path.
/// @thread  any.
[[nodiscard]] Result<Log> read_log_file(const std::string& path);

/// Returns the range from which on the front laser's readings mean that there was no echo: as its lines or the log's parameters say, or the
/// largest reading if it is there more than once, or 0.1 m above it.
/// @thread  pure function; any thread.
[[nodiscard]] double max_range_of(const Log& log, Laser laser);

/// Returns where a laser is on its robot: as the log's parameters say; else as all its lines say by their poses, within 1 cm and 0.5 degrees;
/// else at the middle, looking ahead.
/// @thread  pure function; any thread.
[[nodiscard]] Pose2 mount_of(const Log& log, Laser laser);

}  // namespace orca::carmen
