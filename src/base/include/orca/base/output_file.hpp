// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "orca/base/result.hpp"

namespace orca {

/// A file that is written from its start to its end. No failure is lost: the first one is kept and returned by
/// close(). It refuses to overwrite a file that this process reads or that another OutputFile writes.
///
/// SIGPIPE and SIGXFSZ must be ignored; their causes are then failures like others.
///
/// Thread contract: not synchronised.
class OutputFile {
 public:
  /// @param what  the file for people: "the trace".
  explicit OutputFile(std::string what) : what_(std::move(what)) {}
  /// Closes it.
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Opens a file, which is emptied when the first text is written. It may be a device, or a pipe that somebody
  /// reads.
  /// @errors  invalid_argument if the file is an input or another output; unavailable with the system's
  ///          reason.
  Status open(const std::string& path);
  [[nodiscard]] bool is_open() const { return fd_ >= 0; }

  /// Appends a text; it may stay in a buffer until close().
  void write(std::string_view text);

  /// Writes what is in the buffer. The first call empties the file before, even if the buffer is empty.
  void flush();

  /// Writes what is left, also to the disk, and closes the file. If there was nothing to write, an old file stays
  /// as it was, and a new one is removed.
  /// @errors  unavailable with the reason of the first failure, if any write has failed.
  Status close();

 private:
  void begin();
  void write_buffer();
  void note_failure();

  const std::string what_;
  std::string path_;
  int fd_ = -1;
  bool created_ = false;  // it did not exist before
  bool begun_ = false;    // it has been emptied
  std::string buffer_;
  int failure_ = 0;  // errno of the first failure; 0: none
};

}  // namespace orca
