// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/idl/object.hpp"
#include "orca/recording/objects/object_writer.hpp"

namespace orca::recording {

/// A recording without an end, in a folder of bounded size. It consists of two rows of files: one for objects of at most
/// kSmall bytes (alarms, log, states, commands, odometry), one for the rest (scans, images, maps). Each row has half of the room.
/// When a row is full its oldest file goes, and the messages in it are counted; so the small objects, which are few bytes, reach
/// much further back than the rest. Files of earlier runs belong to the same rows.
///
/// Each file is a whole recording, named "000017-small-20261129T140322Z.mcap" after its number, its row and when it begins. Whoever is
/// killed leaves files that are read as far as they go.
///
/// Thread contract: as ObjectSink. It has no clock: times are those of the objects.
class RingWriter final : public ObjectSink {
 public:
  static constexpr std::size_t kSmall = 1024;  ///< [bytes] as they travel.
  static constexpr std::uint64_t kFiles = 16;  ///< In a row that is full.
  static constexpr Duration kAge = 14 * 24h;   ///< Older files go, even if there is room.
  static constexpr Duration kFileTime = 24h;   ///< Then the next file begins, even if this one is small.
  static constexpr std::uint64_t kLeast = 20'000'000;  ///< [bytes] of room.

  /// @param folder  is made if it is not there.
  /// @param room    [bytes] that all files together take at most, but for an object that is larger than a file: kLeast at least.
  RingWriter(std::string folder, std::uint64_t room);
  ~RingWriter() override;

  Status begin(const Origin& origin) override;
  Status attach_graph(const std::string& graph) override;
  Status attach_json(const std::string& name, const std::string& text) override;
  /// @errors  as Writer; unavailable if a file cannot be made or removed.
  Status add(std::string_view row, const ObjectRef& object, TimePoint passed) override;
  Status flush() override;
  Status close(const std::map<std::string, std::uint64_t>& lost, const Values& more) override;
  [[nodiscard]] std::uint64_t messages() const override;
  [[nodiscard]] std::uint64_t size() const override;

 private:
  struct Row {
    std::string_view name;
    std::unique_ptr<ObjectWriter> file{};  // null: none is open
    TimePoint begun{};                     // of the file
    std::uint64_t head = 0;                // [bytes] of what the file begins with
    std::uint64_t dropped = 0;             // messages of files that went, in all runs
  };
  Status write_head(Row& row);
  Status make_ready(Row& row, TimePoint now);
  Status make_room(Row& row, TimePoint now);
  Status finish(Row& row, const std::map<std::string, std::uint64_t>& lost, const Values& more);

  const std::filesystem::path folder_;
  const std::uint64_t row_room_;  // [bytes]
  std::array<Row, 2> rows_{Row{"small"}, Row{"rest"}};
  Origin origin_;
  std::string graph_;
  std::map<std::string, std::string> texts_;  // in JSON, by name
  std::uint64_t messages_ = 0;                // in files that are closed
  std::uint64_t size_ = 0;                    // [bytes] of them
};

/// A file of such a recording.
struct RingFile {
  std::uint64_t number = 0;
  std::string row;    ///< "small" or "rest".
  TimePoint begun{};  ///< [s] to which it begins; 1970 if its name does not say so.
  std::filesystem::path path;
  std::uint64_t size = 0;  ///< [bytes]
};

/// Returns the files of a RingWriter in a folder, oldest first; none if there is no such folder.
[[nodiscard]] std::vector<RingFile> ring_files(const std::filesystem::path& folder);

}  // namespace orca::recording
