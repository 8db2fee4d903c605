// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "bytes.hpp"
#include "orca/base/result.hpp"
#include "orca/recording/mcap.hpp"

namespace orca::recording {

inline constexpr std::uint8_t kMagic[] = {0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};

/// The kinds of record.
enum class Op : std::uint8_t {
  header = 1,
  footer,
  schema,
  channel,
  message,
  chunk,
  message_index,
  chunk_index,
  attachment,
  attachment_index,
  statistics,
  metadata,
  metadata_index,
  summary_offset,
  data_end,
};

struct Header {
  std::string profile;
  std::string library;
};
struct Footer {
  std::uint64_t summary_start = 0;  ///< 0: there is no summary.
  std::uint64_t summary_offset_start = 0;
  std::uint32_t summary_crc = 0;  ///< 0: none.
};
inline constexpr std::size_t kRecordHead = 9;    ///< [bytes] of opcode and length.
inline constexpr std::size_t kFooterBytes = 20;  ///< [bytes] of a footer's content.

/// Append a record.
void put_magic(Bytes& out);
void put_record(Bytes& out, Op op, std::span<const std::byte> content);
void put_record(Bytes& out, const Header& header);
void put_record(Bytes& out, const Schema& schema);
void put_record(Bytes& out, const Channel& channel);
void put_record(Bytes& out, const Message& message);
void put_record(Bytes& out, const Attachment& attachment);
void put_record(Bytes& out, const Metadata& metadata);

/// Read a record's content; nothing if it is damaged.
[[nodiscard]] std::optional<Header> read_header(std::span<const std::byte> content);
[[nodiscard]] std::optional<Schema> read_schema(std::span<const std::byte> content);
[[nodiscard]] std::optional<Channel> read_channel(std::span<const std::byte> content);
[[nodiscard]] std::optional<Message> read_message(std::span<const std::byte> content);
/// Checks its CRC as well.
[[nodiscard]] std::optional<Attachment> read_attachment(std::span<const std::byte> content);
[[nodiscard]] std::optional<Metadata> read_metadata(std::span<const std::byte> content);
[[nodiscard]] std::optional<Footer> read_footer(std::span<const std::byte> content);

/// A record of a file, or of a chunk.
struct Record {
  Op op{};
  std::uint64_t offset = 0;  ///< [bytes] of its first byte.
  std::span<const std::byte> content;

  [[nodiscard]] std::uint64_t end() const { return offset + kRecordHead + content.size(); }
};

/// A walk along records that nobody vouches for.
class RecordWalk {
 public:
  /// @param offset  [bytes] of the first record in `bytes`.
  explicit RecordWalk(std::span<const std::byte> bytes, std::uint64_t offset = 0)
      : bytes_(bytes), at_(offset) {}

  /// Returns the next record; nothing at the end, or where the bytes are cut off.
  [[nodiscard]] std::optional<Record> next();
  /// Returns where the next record begins, or would.
  [[nodiscard]] std::uint64_t offset() const { return at_; }
  /// Returns whether all bytes belong to records.
  [[nodiscard]] bool is_at_end() const { return at_ == bytes_.size(); }

 private:
  std::span<const std::byte> bytes_;
  std::uint64_t at_;
};

/// A chunk whose content is there.
struct OpenChunk {
  Stamp start = 0;
  Stamp end = 0;
  std::string compression;
  std::uint64_t compressed_size = 0;
  Bytes content;
};

/// Opens a chunk, and checks its CRC.
/// @errors  data_loss; unimplemented for another compression; unavailable without memory.
[[nodiscard]] Result<OpenChunk> open_chunk(std::span<const std::byte> content);

}  // namespace orca::recording
