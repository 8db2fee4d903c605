// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "bytes.hpp"
#include "orca/recording/mcap.hpp"
#include "records.hpp"

namespace orca::recording {

/// What stands at the end of a file: what is in it, and where. Once written it is read back into the same form.
///
/// Thread contract: not synchronised.
class Summary {
 public:
  std::map<std::uint16_t, Schema> schemas;
  std::map<std::uint16_t, Channel> channels;
  std::vector<ChunkIndex> chunks;
  std::vector<IndexEntry> attachments;
  std::vector<IndexEntry> metadata;
  Statistics statistics;

  /// Counts a message.
  void count(const Message& message);
  /// Returns everything that follows the data: DataEnd, summary, footer and magic.
  /// @param offset  [bytes] at which it will stand.
  [[nodiscard]] Bytes encode(std::uint64_t offset) const;

  /// Takes a record of a summary; others are ignored. Returns false if it is damaged.
  bool take(const Record& record);
};

/// A chunk in the making.
class ChunkBuilder {
 public:
  void add(const Message& message);
  [[nodiscard]] bool is_empty() const { return content_.empty(); }
  [[nodiscard]] std::size_t size() const { return content_.size(); }
  [[nodiscard]] Stamp start() const { return start_; }

  /// Appends the chunk and its message indexes, and empties itself.
  /// @param offset  [bytes] at which `out` begins in the file.
  /// @return where what is.
  /// @errors  as compress(); nothing is appended then.
  Result<ChunkIndex> close(Bytes& out, std::uint64_t offset);

 private:
  Bytes content_;
  Stamp start_ = 0;
  Stamp end_ = 0;
  std::map<std::uint16_t, std::vector<std::pair<Stamp, std::uint64_t>>> places_;  // by channel
};

/// Appends the record of a chunk whose messages are known, with its message indexes.
ChunkIndex put_chunk(Bytes& out, std::uint64_t offset, std::span<const std::byte> chunk_record,
                     const OpenChunk& chunk);

}  // namespace orca::recording
