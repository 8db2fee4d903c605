// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "orca/base/log.hpp"
#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/idl/object.hpp"
#include "orca/recording/writer.hpp"
#include "orca/ros/frame_tree.hpp"

namespace orca::recording {

/// The rows of a recording that belong to no port.
inline constexpr std::string_view kLogRow = "log";       ///< LogRecord: lines of the log.
inline constexpr std::string_view kAlarmRow = "alarms";  ///< Alarm: raised and cleared.

/// What a recording says of itself, in the metadata "orca.recording".
struct Origin {
  std::string graph;        ///< Name of the system.
  bool is_virtual = false;  ///< Times count from the beginning of the run, not from 1970.
  std::vector<std::string>
      ports;    ///< "base.OdometryPush": those that are recorded, whether or not anything passes.
  Values more;  ///< What else is known: "seed".
};

/// Where objects go that are recorded.
///
/// Thread contract: one thread at a time.
class ObjectSink {
 public:
  ObjectSink() = default;
  virtual ~ObjectSink() = default;
  ObjectSink(const ObjectSink&) = delete;
  ObjectSink& operator=(const ObjectSink&) = delete;

  /// Says what the recording is of. The first call.
  /// @errors  as Writer.
  virtual Status begin(const Origin& origin) = 0;
  /// Puts the text of the graph, and the files that its parameters name, into the recording; but no other recordings.
  /// @param graph  as graph::print() writes it.
  virtual Status attach_graph(const std::string& graph) = 0;
  /// Puts a text in JSON into the recording, under a name.
  virtual Status attach_json(const std::string& name, const std::string& text) = 0;
  /// Adds an object.
  /// @param row     "base.OdometryPush", or a row without a port.
  /// @param passed  when it passed, by the run's clock.
  /// @errors  as Writer.
  virtual Status add(std::string_view row, const ObjectRef& object, TimePoint passed) = 0;
  /// Writes what waits for its chunk.
  virtual Status flush() = 0;
  /// Ends the recording. The last call.
  /// @param lost  objects that could not be recorded, by port; they are in the metadata "orca.end".
  /// @param more  what else is known at the end: "trace-hash".
  virtual Status close(const std::map<std::string, std::uint64_t>& lost, const Values& more) = 0;
  /// Returns how many messages were written, twins of objects included.
  [[nodiscard]] virtual std::uint64_t messages() const = 0;
  [[nodiscard]] virtual std::uint64_t size() const = 0;  ///< [bytes] written.
};

/// A writer of objects into a recording. Each port has a channel with the topic "/base/OdometryPush", and objects are written as
/// they travel: CDR, with their layout as a "ros2msg" schema. What viewers of ROS 2 know is written a second time as they know it,
/// under "/ros/base/OdometryPush", "/tf" and "/rosout".
///
/// Thread contract: one thread at a time.
class ObjectWriter final : public ObjectSink {
 public:
  /// @param output  where to; see Output.
  explicit ObjectWriter(std::unique_ptr<Output> output);

  Status begin(const Origin& origin) override;
  Status attach_graph(const std::string& graph) override;
  Status attach_json(const std::string& name, const std::string& text) override;
  Status add(std::string_view row, const ObjectRef& object, TimePoint passed) override;
  Status flush() override { return writer_.flush(); }
  Status close(const std::map<std::string, std::uint64_t>& lost, const Values& more) override;
  [[nodiscard]] std::uint64_t messages() const override { return writer_.statistics().messages; }
  [[nodiscard]] std::uint64_t size() const override { return writer_.size(); }

 private:
  struct Row {
    std::uint16_t channel = 0;
    std::uint16_t twin = 0;  // channel; 0: none yet
  };
  using TypeRows = std::vector<std::pair<const ObjectType*, Row>>;  // few

  Row& row_of(std::string_view row, const ObjectType& type);
  std::uint16_t channel_of(std::string_view message_type, const std::string& topic);
  Status add_twins(std::string_view row, Row& places, const ObjectRef& object, const Message& like);

  Writer writer_;
  ros::FrameTree frames_;
  std::map<std::string, TypeRows, std::less<>> rows_;
  std::uint16_t frames_channel_ = 0;
  std::vector<std::byte> payload_;
};

/// Returns a line of the log as an object.
[[nodiscard]] ObjectRef log_record(log::Level level, const std::string& source, const std::string& text,
                                   TimePoint written);

/// Returns the topic of a row: "/base/OdometryPush" of "base.OdometryPush".
[[nodiscard]] std::string topic_of(std::string_view row);

}  // namespace orca::recording
