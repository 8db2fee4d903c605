// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/recording/reader.hpp"
#include "records.hpp"
#include "summary.hpp"

namespace orca::recording {

/// What was found by reading all records of a file's data, one after the other.
struct Scanned {
  Header header;
  Summary summary;
  std::vector<Record> loose;  ///< Messages outside chunks.
  std::vector<Finding> findings;
  std::uint64_t whole =
      0;  ///< [bytes] of the records before the first one that is cut off, or before the end of the data.
  bool has_end = false;  ///< The data have an end.
};

/// Those who look on at a scan.
struct Onlookers {
  /// Takes each record that is in order, except those of indexes; a chunk is open then. An error ends the scan.
  std::function<Status(const Record& record, const OpenChunk* chunk)> record = {};
  /// Takes each message.
  std::function<void(const Message& message)> message = {};
};

/// Reads all records of a file's data.
/// @errors  invalid_argument if it is no MCAP file; as the onlookers.
[[nodiscard]] Result<Scanned> scan(std::span<const std::byte> bytes, const Onlookers& onlookers);

}  // namespace orca::recording
