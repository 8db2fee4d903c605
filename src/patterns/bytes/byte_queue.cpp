// SPDX-License-Identifier: LGPL-3.0-or-later
#include "byte_queue.hpp"

#include <algorithm>

namespace orca::bytes {

std::size_t ByteQueue::write(std::span<const std::byte> bytes) {
  const std::size_t written = written_.load(std::memory_order_relaxed);
  const std::size_t room = ring_.size() - (written - read_.load(std::memory_order_acquire));
  const std::size_t count = std::min(bytes.size(), room);
  const std::size_t at = written % ring_.size();
  const std::size_t first = std::min(count, ring_.size() - at);
  std::copy_n(bytes.begin(), first, ring_.begin() + static_cast<std::ptrdiff_t>(at));
  std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(first), count - first, ring_.begin());
  written_.store(written + count, std::memory_order_release);
  return count;
}

std::size_t ByteQueue::read(std::span<std::byte> to) {
  const std::size_t read = read_.load(std::memory_order_relaxed);
  const std::size_t count = std::min(to.size(), written_.load(std::memory_order_acquire) - read);
  const std::size_t at = read % ring_.size();
  const std::size_t first = std::min(count, ring_.size() - at);
  std::copy_n(ring_.begin() + static_cast<std::ptrdiff_t>(at), first, to.begin());
  std::copy_n(ring_.begin(), count - first, to.begin() + static_cast<std::ptrdiff_t>(first));
  read_.store(read + count, std::memory_order_release);
  return count;
}

}  // namespace orca::bytes
