// SPDX-License-Identifier: LGPL-3.0-or-later
// The parts of an MCAP file (https://mcap.dev/spec), as plain values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace orca::recording {

/// A time in an MCAP file [ns]: since 1970 by the wall clock, or by another clock that the file's metadata names.
using Stamp = std::uint64_t;
using Values = std::map<std::string, std::string>;

/// The layout of the messages of a channel, for readers of many kinds.
struct Schema {
  std::uint16_t id = 0;  ///< Not 0.
  std::string name;      ///< "sensor_msgs/msg/LaserScan"
  std::string encoding;  ///< "ros2msg"
  std::string data;
};

/// A row of messages under one topic.
struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema = 0;  ///< 0: none.
  std::string topic;
  std::string message_encoding;  ///< "cdr"
  Values metadata;
};

/// A message. It refers to its payload, which somebody else keeps.
struct Message {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  Stamp log_time = 0;      ///< When it was recorded.
  Stamp publish_time = 0;  ///< When its content came into being.
  std::span<const std::byte> payload;
};

/// A file within the file.
struct Attachment {
  Stamp log_time = 0;
  Stamp create_time = 0;
  std::string name;
  std::string media_type;
  std::vector<std::byte> data;
};

/// Texts under a name.
struct Metadata {
  std::string name;
  Values values;
};

/// The place of an attachment or of metadata.
struct IndexEntry {
  std::uint64_t offset = 0;  ///< [bytes] from the beginning of the file to the record.
  std::uint64_t length = 0;  ///< [bytes] of the whole record.
  std::string name;
  std::string media_type;       ///< Of an attachment.
  std::uint64_t data_size = 0;  ///< [bytes] Of an attachment.
  Stamp log_time = 0;           ///< Of an attachment.
  Stamp create_time = 0;        ///< Of an attachment.
};

/// The place of a chunk.
struct ChunkIndex {
  Stamp start = 0;  ///< The first log_time in it.
  Stamp end = 0;    ///< The last one.
  std::uint64_t offset = 0;
  std::uint64_t length = 0;                                      ///< [bytes] of the whole record.
  std::map<std::uint16_t, std::uint64_t> message_index_offsets;  ///< By channel.
  std::uint64_t message_index_length = 0;                        ///< [bytes]
  std::string compression;                                       ///< "zstd", "lz4" or "".
  std::uint64_t compressed_size = 0;
  std::uint64_t uncompressed_size = 0;
};

/// The size of a file's contents.
struct Statistics {
  std::uint64_t messages = 0;
  std::uint32_t chunks = 0;
  Stamp start = 0;  ///< The first log_time; 0: there are no messages.
  Stamp end = 0;
  std::map<std::uint16_t, std::uint64_t> by_channel;
};

}  // namespace orca::recording
