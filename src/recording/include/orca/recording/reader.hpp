// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/recording/mcap.hpp"
#include "orca/recording/output.hpp"

namespace orca::recording {

class Storage;

/// What is wrong with a file, and where.
struct Finding {
  std::uint64_t offset = 0;  ///< [bytes] 0: no one place.
  std::string text;
};

/// A reader of the messages of one recording, whoever has written it. It believes nothing that it reads, and writes nothing. A recording is
///
/// * an MCAP file, as far as its chunks are not compressed or compressed with zstd or lz4. A file without an end, of a writer that was
///   killed, is read as far as its records are whole;
/// * an SQLite database of rosbag2, schema version 1 to 4;
/// * the folder of a bag, with one such file, or with NAME_0, NAME_1 and so on, whose messages are put into one order.
///
/// Thread contract: constant; any thread.
class Reader {
 public:
  /// Opens a recording.
  /// @errors  invalid_argument if it cannot be read, or is none; not_found for a folder without such files, with one missing, or with
  ///          several that are no one bag; failed_precondition for a database that its writer has not finished (a -wal or -journal
  ///          file lies beside it), or of another schema version; data_loss for a database whose beginning is damaged;
  ///          unimplemented for a file that is compressed as a whole.
  [[nodiscard]] static Result<Reader> open(const std::string& path);
  /// Reads bytes, which outlive the reader.
  /// @errors  invalid_argument if they are no MCAP file.
  [[nodiscard]] static Result<Reader> of(std::span<const std::byte> bytes);
  ~Reader();
  Reader(Reader&&) noexcept;
  Reader& operator=(Reader&&) noexcept;

  [[nodiscard]] const std::string& library() const;
  [[nodiscard]] std::uint64_t size() const;  ///< [bytes] of its files.
  /// Returns whether an MCAP file has an end with an index; without one, the file was read through to find what is in it.
  [[nodiscard]] bool has_index() const;
  [[nodiscard]] const std::map<std::uint16_t, Schema>& schemas() const;
  [[nodiscard]] const std::map<std::uint16_t, Channel>& channels() const;
  [[nodiscard]] const Statistics& statistics() const;
  [[nodiscard]] const std::vector<ChunkIndex>& chunks() const;
  [[nodiscard]] const std::vector<IndexEntry>& attachments() const;
  [[nodiscard]] const std::vector<IndexEntry>& metadata() const;
  /// Returns what could not be read when the file was opened without an index.
  [[nodiscard]] const std::vector<Finding>& findings() const;

  /// @errors  data_loss.
  [[nodiscard]] Result<Attachment> attachment(const IndexEntry& entry) const;
  [[nodiscard]] Result<Metadata> metadata(const IndexEntry& entry) const;

  /// Passes messages on in the order of log_time; those of one time in the order of the file.
  /// @param channels  which; empty: all.
  /// @param take      returns false to end.
  /// @param from      least log_time; chunks that end before it are not opened.
  /// @errors  data_loss if a chunk is damaged, or if chunks of more than 512 MiB are of the same time, for they are sorted in
  ///          memory; unavailable without memory. What came before was passed on.
  Status messages(const std::set<std::uint16_t>& channels, const std::function<bool(const Message&)>& take,
                  Stamp from = 0) const;

 private:
  explicit Reader(std::unique_ptr<Storage> inside);

  std::unique_ptr<Storage> inside_;
};

/// Returns whether a path is a folder, or a file that begins as Reader::open() knows recordings.
/// @thread  any.
[[nodiscard]] bool is_recording(const std::string& path);

/// Returns whether a folder holds files of a bag.
/// @thread  any.
[[nodiscard]] bool is_bag_folder(const std::string& path);

/// What a check or a recovery has found.
struct Examination {
  std::vector<Finding> findings;     ///< Empty: the file is in order.
  Statistics statistics;             ///< Of the messages that are whole.
  std::uint64_t whole = 0;           ///< [bytes] of the records before the first one that is cut off.
  std::vector<std::string> remarks;  ///< What is no fault: "/base/OdometryPush: numbers 4 to 7 are missing".
};

/// Reads all of an MCAP file: every record, checksum and reference, and whether the index says the same as the data; all pages and messages
/// of a database; each file of a bag's folder.
/// @errors  as Reader::open(), of each file alone.
[[nodiscard]] Result<Examination> check(std::span<const std::byte> bytes);
[[nodiscard]] Result<Examination> check(const std::string& path);

/// Writes what is whole of an MCAP file as a file with an index. Damaged chunks and a torn end are left out and found.
/// @errors  invalid_argument if it cannot be read, or is no MCAP file; unimplemented for a database; as Output::append().
[[nodiscard]] Result<Examination> recover(const std::string& path, std::unique_ptr<Output> to);
[[nodiscard]] Result<Examination> recover(std::span<const std::byte> bytes, std::unique_ptr<Output> to);

}  // namespace orca::recording
