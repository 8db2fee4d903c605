// SPDX-License-Identifier: LGPL-3.0-or-later
// What a Reader reads: one class for each form of recording.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "mapped_file.hpp"
#include "orca/base/result.hpp"
#include "orca/recording/reader.hpp"
#include "summary.hpp"

namespace orca::recording {

/// What is in a recording, and how its messages are read.
///
/// Thread contract: constant once it was opened; any thread.
class Storage {
 public:
  Storage() = default;
  virtual ~Storage() = default;
  Storage(const Storage&) = delete;
  Storage& operator=(const Storage&) = delete;

  /// As Reader::messages().
  [[nodiscard]] virtual Status messages(const std::set<std::uint16_t>& channels,
                                        const std::function<bool(const Message&)>& take,
                                        Stamp from) const = 0;

  std::string library;
  std::uint64_t size = 0;            ///< [bytes] of its files.
  std::span<const std::byte> bytes;  ///< Of an MCAP file, to which the places in the summary refer.
  Summary summary;
  std::vector<Finding> findings;
  bool has_index = false;
};

[[nodiscard]] bool is_mcap(std::span<const std::byte> bytes);
/// @errors  invalid_argument if they are no MCAP file.
[[nodiscard]] Result<std::unique_ptr<Storage>> read_mcap(std::span<const std::byte> bytes);
[[nodiscard]] Result<std::unique_ptr<Storage>> open_mcap(MappedFile file);

[[nodiscard]] bool is_database(std::span<const std::byte> bytes);
/// Opens an SQLite database of rosbag2.
/// @errors  as Reader::open().
[[nodiscard]] Result<std::unique_ptr<Storage>> open_database(const std::string& path);
/// Reads all of one.
/// @errors  as open_database().
[[nodiscard]] Result<Examination> check_database(const std::string& path);

/// Returns a sentence with the command that saves what is whole of a damaged one.
[[nodiscard]] std::string rescue_of(const std::string& path);

/// Returns the files of a recording: of a bag's folder those in it, in the order of their numbers; else the path itself.
/// @errors  not_found and unimplemented as Reader::open().
[[nodiscard]] Result<std::vector<std::string>> files_of(const std::string& path);
/// Puts the messages of several files into one order.
/// @pre  there are two at least.
[[nodiscard]] std::unique_ptr<Storage> join(std::vector<std::unique_ptr<Storage>> parts);

}  // namespace orca::recording
