// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <mutex>
#include <span>
#include <vector>

#include "byte_queue.hpp"
#include "courier.hpp"
#include "orca/base/executive.hpp"

namespace orca::bytes {

/// One direction of a link: a stream of bytes. A courier carries them from the sender's queue to the
/// receiver's queue. A writer may find no room; a reader gets the bytes in portions of any size.
///
/// Thread contract: write() from one thread at a time, read() likewise, carry() from the courier; the rest
/// from any thread.
class ByteWire {
 public:
  /// @param capacity [bytes] of each of the two queues, at least 1.
  ByteWire(Courier& courier, std::size_t capacity);

  /// Appends as many of the bytes as there is room for; none once the wire is closed.
  /// @return the number of bytes appended.
  std::size_t write(std::span<const std::byte> bytes);
  /// Takes bytes that have arrived.
  /// @return the number of bytes taken.
  std::size_t read(std::span<std::byte> to);

  /// Sets who is notified when bytes have arrived, and when there is room again. Null: nobody.
  void set_receiver(Event* event);
  void set_sender(Event* event);

  void close();
  [[nodiscard]] bool closed() const { return closed_.load(std::memory_order_acquire); }

  /// Moves a portion of the bytes on.
  /// @return whether it moved any: there were some, and there was room for them.
  bool carry();

 private:
  void notify(Event* const& event);

  Courier& courier_;
  ByteQueue outgoing_;
  ByteQueue incoming_;
  std::vector<std::byte> portion_;  // the courier's: taken from outgoing_, not yet all in incoming_
  std::size_t put_ = 0;             // so many of it are in incoming_
  std::atomic<bool> closed_{false};

  std::mutex mutex_;
  // Below: guarded by mutex_.
  Event* sender_ = nullptr;
  Event* receiver_ = nullptr;
};

}  // namespace orca::bytes
