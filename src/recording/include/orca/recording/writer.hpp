// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "orca/base/result.hpp"
#include "orca/recording/mcap.hpp"
#include "orca/recording/output.hpp"

namespace orca::recording {

/// A writer of one MCAP file. Messages are collected in chunks, which are compressed with zstd and written with their indexes
/// in one piece: whoever is killed loses the last chunk, and nothing else. Schemas and channels stand outside the chunks, so that a
/// damaged chunk costs nothing but its own messages.
///
/// After an error nothing more is written; each call returns it again.
///
/// Thread contract: one thread at a time.
class Writer {
 public:
  /// A chunk is closed when it has this size [bytes], or at the first message that is later than its first one by
  /// kChunkTime [ns of log_time].
  static constexpr std::size_t kChunkBytes = 768 * 1024;
  static constexpr Stamp kChunkTime = 250'000'000;

  /// @param profile  "ros2" or ""; library: who writes.
  Writer(std::unique_ptr<Output> output, const std::string& profile, const std::string& library);
  /// Closes the file.
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  /// Returns the number of a schema, which is written at its first use.
  std::uint16_t add_schema(const std::string& name, const std::string& encoding, const std::string& data);
  /// Adds a channel. @return its number.
  std::uint16_t add_channel(std::uint16_t schema, const std::string& topic,
                            const std::string& message_encoding, const Values& metadata);
  /// Adds a message. @pre  its channel was added.
  /// @errors  as Output::append(); unavailable without memory to compress.
  Status write(const Message& message);
  Status attach(const Attachment& attachment);
  Status note(const Metadata& metadata);
  /// Closes the chunk and writes it, if there is anything in it.
  Status flush();
  /// Writes the rest, the summary and the footer. The last call.
  Status close();

  [[nodiscard]] const Statistics& statistics() const;
  /// Returns how many bytes the file has so far, without the chunk in the making.
  [[nodiscard]] std::uint64_t size() const;

 private:
  struct Inside;
  const std::unique_ptr<Inside> inside_;
};

}  // namespace orca::recording
