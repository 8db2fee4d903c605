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

/// Returns what is wrong with an MCAP file that has no index, so that what can be read of it may not be all; empty: nothing, or it has one.
/// @thread  pure function; any thread.
[[nodiscard]] std::string damage_of(const Reader& file);

/// Returns the row that a name means: that of this name; in a bag, whose rows are topics, also the only topic with objects of the type that
/// the name of a port ends with, so that `laser.LaserRangeReadingsPush` means its scans.
/// @param others  topics without objects, and the types of their messages, for a refusal that says more.
/// @errors  not_found; invalid_argument if several topics have such objects. The text lists what is there.
/// @thread  any.
[[nodiscard]] Result<std::string> find_row(const std::map<std::string, RecordedRow>& rows,
                                           const std::map<std::string, std::string>& others,
                                           const std::string& name);

/// A reader of the objects that an ObjectWriter has written, beside which it passes over all else; or of a recording of ROS 2 (a bag),
/// in which nothing is Orca's: a row for each topic whose messages objects can say, named as the topic. Where sensors are is what
/// the bag's /tf_static says.
///
/// Thread contract: constant; any thread.
class ObjectReader {
 public:
  /// Opens a recording.
  /// @errors  as Reader::open(); failed_precondition if it has objects of a type that is not known here, or that has another layout
  ///          here.
  [[nodiscard]] static Result<ObjectReader> open(const std::string& path);

  [[nodiscard]] const Reader& file() const { return file_; }
  /// Returns the rows, by name.
  [[nodiscard]] const std::map<std::string, RecordedRow>& rows() const { return rows_; }
  /// Returns the topics of a bag that have no objects, with the types of their messages.
  [[nodiscard]] const std::map<std::string, std::string>& others() const { return others_; }
  /// Returns whether it is a bag.
  [[nodiscard]] bool is_bag() const { return is_bag_; }
  /// Returns facts_of(file()).
  [[nodiscard]] const Values& facts() const { return facts_; }
  [[nodiscard]] bool is_virtual() const;

  /// Passes objects on in the order in which they have passed.
  /// @param rows  which; empty: all.
  /// @param take  returns false to end.
  /// @param flaws  gets sentences about messages of a bag that are left out, and about places of sensors that it does not say; null: they go
  ///               to the log.
  /// @errors  data_loss if the file is damaged; unimplemented if messages are compressed one by one. What came before was passed on.
  Status objects(const std::set<std::string>& rows, const std::function<bool(const RecordedObject&)>& take,
                 std::vector<std::string>* flaws = nullptr) const;

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
  [[nodiscard]] Result<ObjectRef> object_of(const Source& source, const Message& message,
                                            std::set<std::string>& unknown_frames) const;

  Reader file_;
  ros::FrameTree frames_;
  std::map<std::uint16_t, Source> sources_;  // by channel
  std::map<std::string, RecordedRow> rows_;
  std::map<std::string, std::string> others_;
  bool is_bag_ = false;
  Values facts_;
};

}  // namespace orca::recording
