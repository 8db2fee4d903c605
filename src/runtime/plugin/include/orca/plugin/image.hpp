// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <utility>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"

namespace orca::plugin {

/// The bytes of a plugin's file as they were at one moment. Nothing can change them any more, whatever becomes of the
/// file, and no other image has its name, so the dynamic linker cannot take it for a library that it has loaded before.
/// The bytes are in memory; they are gone when the image and all libraries that were loaded from it are.
///
/// Thread contract: not synchronised; it may move between threads.
class PluginImage {
 public:
  /// Copies a file.
  /// @errors  not_found if there is no such file; failed_precondition if others can write it (orca/base/files/trusted_code.hpp); unavailable if it cannot be read, or memory is short.
  static Result<PluginImage> copy(const std::string& file);

  /// Takes over an image that another process has made.
  /// @param origin  the file that it was copied from.
  PluginImage(Descriptor bytes, std::string origin) : bytes_(std::move(bytes)), origin_(std::move(origin)) {}

  /// Returns the absolute path of the file that it was copied from, for people.
  [[nodiscard]] const std::string& origin() const { return origin_; }
  /// Returns the path under which this process can open the bytes.
  [[nodiscard]] std::string path() const { return "/proc/self/fd/" + std::to_string(bytes_.number()); }
  /// Returns the name of the bytes in a process's memory map.
  [[nodiscard]] std::string mapped_name() const;
  /// Gives the bytes away, to be passed to another process.
  [[nodiscard]] Descriptor take_bytes() && { return std::move(bytes_); }

 private:
  Descriptor bytes_;
  std::string origin_;
};

}  // namespace orca::plugin
