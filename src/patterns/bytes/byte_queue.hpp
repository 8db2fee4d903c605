// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

namespace orca::bytes {

/// A bounded queue of bytes, without locks.
///
/// Thread contract: write() from one thread at a time, read() from one thread at a time.
class ByteQueue {
 public:
  explicit ByteQueue(std::size_t capacity) : ring_(capacity) {}

  /// Appends as many of the bytes as there is room for.
  /// @return the number of bytes appended.
  std::size_t write(std::span<const std::byte> bytes);
  /// Moves the oldest bytes into `to`: as many as the queue has and `to` can hold.
  /// @return the number of bytes moved.
  std::size_t read(std::span<std::byte> to);

 private:
  std::vector<std::byte> ring_;
  // Bytes ever written and ever read; the queue holds the difference.
  std::atomic<std::size_t> written_{0};
  std::atomic<std::size_t> read_{0};
};

}  // namespace orca::bytes
