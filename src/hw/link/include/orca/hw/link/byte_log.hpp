// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "orca/base/result.hpp"
#include "orca/hw/link/byte_link.hpp"
#include "orca/hw/link/byte_record.hpp"

namespace orca::hw::link {

class LogWriter;

struct ByteLogOptions {
  std::string path;
  std::size_t most_bytes = std::size_t{64}
                           << 20;  ///< Size at which the file ends with the line "full" [bytes].
  NowFunction now;                 ///< The clock of the times in it.
};

/// A file with what went over a link, in the form of byte_record.hpp. An older file of that name is replaced.
///
/// A disk that is full, slow or gone costs the log, never the device: then nothing more is written, and the process's
/// log says so once.
///
/// Thread contract: one strand.
class ByteLog {
 public:
  /// @param about  what is recorded, for people: the link's name.
  /// @errors  invalid_argument if this process reads that file, unavailable if it cannot be written.
  [[nodiscard]] static Result<std::unique_ptr<ByteLog>> create(ByteLogOptions options,
                                                               const std::string& about);
  /// Waits until the disk has got the rest.
  ~ByteLog();
  ByteLog(const ByteLog&) = delete;
  ByteLog& operator=(const ByteLog&) = delete;

  /// Writes a record of one of the kinds with bytes.
  void note(ByteRecord::Kind kind, std::span<const std::uint8_t> bytes);
  /// Writes a record of one of the other kinds.
  void note(ByteRecord::Kind kind, std::string text = {});
  /// Writes a remark for people.
  void remark(const std::string& text);

  /// Returns whether what is noted still gets into the file.
  [[nodiscard]] bool is_writing() const;

 private:
  ByteLog(ByteLogOptions options, std::unique_ptr<LogWriter> writer);
  [[nodiscard]] Duration age();
  void write(const std::string& lines);

  const ByteLogOptions options_;
  const TimePoint start_;
  Duration newest_{0};  // of the times written
  std::size_t size_ = 0;
  bool full_ = false;
  const std::unique_ptr<LogWriter> writer_;
};

}  // namespace orca::hw::link
