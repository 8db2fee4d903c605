// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::recording {

/// Where a recording goes: bytes that are appended piece by piece. After an error nothing more is taken.
///
/// Thread contract: one thread at a time.
class Output {
 public:
  Output() = default;
  virtual ~Output() = default;
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  /// Appends a piece: all of it, or none. The end of a file is never half a piece, unless the machine itself stops.
  /// @errors  unavailable with the system's reason.
  virtual Status append(std::vector<std::byte> piece) = 0;
  /// Makes sure that everything is on the disk. The last call.
  /// @errors  as append().
  virtual Status finish() = 0;
};

/// Opens a new file; each piece is written with one system call, at once.
/// @errors  already_exists: a recording never overwrites anything; invalid_argument or unavailable with the system's reason.
[[nodiscard]] Result<std::unique_ptr<Output>> open_file(const std::string& path);

/// Opens a new file that a thread of its own writes, and makes safe against a loss of power once a second. append() waits only
/// while as many as `bound` [bytes] wait to be written. An error is reported by the next call.
/// @errors  as open_file().
[[nodiscard]] Result<std::unique_ptr<Output>> open_file_in_background(const std::string& path,
                                                                      std::size_t bound);

}  // namespace orca::recording
