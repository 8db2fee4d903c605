// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/idl/object.hpp"
#include "orca/recording/reader.hpp"
#include "orca/ros/frame_tree.hpp"
#include "orca/ros/twin.hpp"

namespace orca::recording {

/// A row of objects in a recording.
struct RecordedRow {
  std::string name;                            ///< "base.OdometryPush", or that of a row without a port.
  std::map<std::string, std::uint64_t> types;  ///< Types of its objects, with how many there are of each.
};

/// An object of a recording.
struct RecordedObject {
  std::string_view row;
  ObjectRef object;
  TimePoint passed;
};

/// Returns the texts that Orca has put into a recording, "orca.recording" and "orca.end", as far as they are there.
/// @thread  any.
[[nodiscard]] Values facts_of(const Reader& file);
/// Returns one of them, or a value of the metadata of a channel; empty: it is not there.
[[nodiscard]] std::string fact(const Values& facts, const std::string& name);

/// A reader of the objects that an ObjectWriter has written, beside which it passes over all else; or of a recording of ROS 2 (a bag),
/// in which nothing is Orca's: a row for each topic whose messages objects can say, named as the topic. Where sensors are is what
/// the bag's /tf_static says.
///
/// Thread contract: constant; any thread.
class ObjectReader {
 public:
  /// Opens a recording.
  /// @param path  a file, or the folder of a bag with one MCAP file.
  /// @errors  as Reader::open(); not_found for a folder without such a file, or with several; failed_precondition if it has objects of a type that is not known here, or that has another layout
  ///          here.
  [[nodiscard]] static Result<ObjectReader> open(const std::string& path);

  [[nodiscard]] const Reader& file() const { return file_; }
  /// Returns the rows, by name.
  [[nodiscard]] const std::map<std::string, RecordedRow>& rows() const { return rows_; }
  /// Returns facts_of(file()).
  [[nodiscard]] const Values& facts() const { return facts_; }
  [[nodiscard]] bool is_virtual() const;

  /// Passes objects on in the order in which they have passed.
  /// @param rows  which; empty: all.
  /// @param take  returns false to end.
  /// @errors  data_loss if the file is damaged; what came before was passed on.
  Status objects(const std::set<std::string>& rows,
                 const std::function<bool(const RecordedObject&)>& take) const;

 private:
  struct Source {
    std::string row;
    const ObjectType* type;
    const ros::Twin* twin;  // by which a message becomes an object; null: it is one
  };
  explicit ObjectReader(Reader file) : file_(std::move(file)) {}
  Status find_rows();
  void find_topics();
  void add_row(std::uint16_t channel, Source source);
  void learn_frames(std::uint16_t channel);
  [[nodiscard]] Result<ObjectRef> object_of(const Source& source, const Message& message) const;

  Reader file_;
  ros::FrameTree frames_;
  std::map<std::uint16_t, Source> sources_;  // by channel
  std::map<std::string, RecordedRow> rows_;
  Values facts_;
};

}  // namespace orca::recording
