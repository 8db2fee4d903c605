// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/recording/objects/object_reader.hpp"

namespace orca::recording {

/// A run of a robot that was recorded, whoever has recorded it.
///
/// Thread contract: constant but for take_objects(); not synchronised.
class RecordedRun {
 public:
  RecordedRun() = default;
  virtual ~RecordedRun() = default;
  RecordedRun(const RecordedRun&) = delete;
  RecordedRun& operator=(const RecordedRun&) = delete;

  /// Opens a recording with objects, a bag of ROS 2, a log of CARMEN, or a table of scans. The first bytes of the file decide which of them it is.
  /// @errors  as ObjectReader::open() or CarmenReader::open().
  [[nodiscard]] static Result<std::unique_ptr<RecordedRun>> open(const std::string& path);

  [[nodiscard]] virtual const std::map<std::string, RecordedRow>& rows() const = 0;
  /// Returns the topics of a bag that have no objects, with the types of their messages.
  [[nodiscard]] virtual std::map<std::string, std::string> others() const { return {}; }
  /// Returns when the run began, by the clock of the recording: a moment before the first object.
  [[nodiscard]] virtual TimePoint begin() const = 0;
  /// Returns the time from the first object to the last.
  [[nodiscard]] virtual Duration length() const = 0;
  /// Passes objects on in the order in which they have passed, once: a run that is held in memory forgets them meanwhile. Where the
  /// stamps of a bag are of another clock, because a simulation ran or nobody had set the robot's, they are moved to that of the recording.
  /// @param rows  those that are wanted, beside which others may come; empty: all.
  /// @errors  as ObjectReader::objects().
  [[nodiscard]] virtual Status take_objects(const std::set<std::string>& rows,
                                            const std::function<void(const RecordedObject&)>& take) = 0;
  /// Returns sentences about what is wrong in the recording, though it can be read. Those about a bag are there when its objects were taken.
  [[nodiscard]] virtual std::vector<std::string> flaws() const { return {}; }
};

}  // namespace orca::recording
