// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"

namespace orca {

/// A file in which a program keeps something from one run to the next. It is written whole or not at all: under another name
/// first, which then takes the place of the old one. The first line says what is kept, how long it is, and its hash, so that a damaged
/// file is noticed, as after a power failure. Nobody waits for the disk.
///
/// Thread contract: not synchronised.
class KeptFile {
 public:
  /// @param kind            what is kept, in one word: "slam_session". A file of another kind is refused.
  /// @param keeps_previous  whether write() leaves what was there before as PATH.old.
  KeptFile(std::string path, std::string kind, bool keeps_previous = false)
      : path_(std::move(path)), kind_(std::move(kind)), keeps_previous_(keeps_previous) {}

  /// Returns what was kept; nothing if there is no such file.
  /// @errors  data_loss if the file is damaged, of another kind, or larger than 1 GB; otherwise those of read_input_file().
  [[nodiscard]] Result<std::optional<std::vector<std::byte>>> read() const;

  /// Replaces what is kept.
  /// @errors  unavailable with the system's reason. Then the file is as it was.
  [[nodiscard]] Status write(std::span<const std::byte> bytes) const;

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  [[nodiscard]] Status write_draft(const std::string& draft, std::span<const std::byte> bytes) const;

  std::string path_;
  std::string kind_;
  bool keeps_previous_;
};

}  // namespace orca
