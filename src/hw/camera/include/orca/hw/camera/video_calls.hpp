// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "orca/base/time.hpp"

namespace orca::hw::camera {

/// What the kernel does for a program that uses Video4Linux2. Tests have a camera of their own behind it.
///
/// Thread contract: of one strand, but for make_system_video()'s, which is any.
/// @source  "Part I - Video for Linux API" of the Linux kernel's userspace-api documentation.
class VideoCalls {
 public:
  VideoCalls() = default;
  virtual ~VideoCalls() = default;
  VideoCalls(const VideoCalls&) = delete;
  VideoCalls& operator=(const VideoCalls&) = delete;

  /// Opens a device for reading and writing, so that no call waits.
  /// @return its descriptor, which has input while a picture waits, or the negative of errno; of ENOTTY if it is no video device.
  virtual int open(const std::string& path) = 0;
  virtual void close(int descriptor) = 0;
  /// @param request, argument  as ioctl() takes them.
  /// @return 0, or errno.
  virtual int control(int descriptor, unsigned long request, void* argument) = 0;
  /// Maps a buffer of the device into memory.
  /// @return where; null if that cannot be done.
  virtual void* map(int descriptor, std::size_t length, std::int64_t offset) = 0;
  virtual void unmap(void* at, std::size_t length) = 0;
  /// Returns the time of the clock of the time stamps, CLOCK_MONOTONIC, from any origin of its own.
  [[nodiscard]] virtual Duration now() const = 0;
};

/// Returns those of the operating system.
[[nodiscard]] std::unique_ptr<VideoCalls> make_system_video();

}  // namespace orca::hw::camera
