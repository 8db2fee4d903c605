// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "orca/base/result.hpp"

namespace orca::recording {

/// The bytes of a file as it was when it was opened. Whoever shortens the file meanwhile ends this process.
class MappedFile {
 public:
  /// @errors  invalid_argument with the system's reason.
  [[nodiscard]] static Result<MappedFile> open(const std::string& path);
  MappedFile() = default;
  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;
  ~MappedFile();

  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace orca::recording
