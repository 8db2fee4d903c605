// SPDX-License-Identifier: LGPL-3.0-or-later

/// @file
/// A ring of records in memory that two processes share: one writes, the other reads.
///
/// A record is its length [bytes, 64 bits] and its contents, in one piece, padded to a multiple of 8 bytes. A length of
/// kSkip means that the next record is at the beginning of the ring. Positions count the bytes ever written and read,
/// so they never go back; the origin is the position that is at the beginning of the ring. A writer moves the origin
/// only while the ring is empty, to its own position: so a quiet edge stays in few pages and in the cache. Nothing
/// that stands in shared memory is trusted: it is read once, and checked.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "orca/base/result.hpp"

namespace orca::shm {

/// The state of a ring, as it stands in shared memory. Each process writes one line of the cache.
struct RingControl {
  // The writer's.
  alignas(64) std::atomic<std::uint64_t> written;  ///< Position behind the last record.
  std::atomic<std::uint64_t> origin;               ///< Position at the beginning of the ring.
  std::atomic<std::uint32_t> writer_waits;         ///< Not 0: for room; the reader rings it when it has read.
  std::atomic<std::uint32_t> closed;               ///< Not 0: nothing more will be written.
  // The reader's.
  alignas(64) std::atomic<std::uint64_t> read;  ///< Position behind the last record that was read.
};

/// Offset of the first ring in a segment [bytes]; before it stand the states of both rings.
inline constexpr std::size_t kControlSize = 4096;
static_assert(2 * sizeof(RingControl) <= kControlSize);

/// A ring as this process has mapped it. Its size is a power of two.
struct Ring {
  RingControl* control;
  std::span<std::byte> data;
};

/// Returns one of the two rings in the memory of a segment.
[[nodiscard]] Ring ring_in(std::span<std::byte> segment, std::size_t index);

/// The outcome of writing a record.
enum class Written { yes, no_room, too_large };

/// The writing side of a ring that is fresh.
///
/// Thread contract: one thread at a time.
class RingWriter {
 public:
  explicit RingWriter(const Ring& ring) : ring_(ring) {}

  /// Returns the largest record that finds room in an empty ring [bytes].
  [[nodiscard]] std::size_t largest() const;

  /// Writes a record straight into the ring.
  /// @param encode  std::size_t(std::span<std::byte> to): writes the record as far as it fits and returns the bytes
  /// that it takes. It is called once or twice.
  /// @errors  data_loss if the reader's position cannot be.
  template <class Encode>
  Result<Written> write(const Encode& encode) {
    Result<Room> room = look_for_room();
    if (!room) return room.error();
    const std::size_t size = encode(place(*room));
    if (size <= room->size) return commit(*room, size);
    if (size > largest()) return Written::too_large;
    const std::optional<Room> other = room_at_front(room->free);
    if (!other || size > other->size) return Written::no_room;
    encode(place(*other));
    return commit(*other, size);
  }

  /// Announces that the writer waits for room, or no longer. After it, room has to be looked for once more.
  void set_waits(bool waits) { ring_.control->writer_waits.store(waits ? 1 : 0, std::memory_order_seq_cst); }
  void close() { ring_.control->closed.store(1, std::memory_order_release); }

 private:
  // A piece of free memory for one record.
  struct Room {
    std::uint64_t at;  // position of the record
    std::size_t size;  // of its contents, at most [bytes]
    std::size_t free;  // bytes in the whole ring that are free
  };

  [[nodiscard]] Result<Room> look_for_room();
  [[nodiscard]] std::optional<Room> room_at_front(std::size_t free) const;
  [[nodiscard]] std::span<std::byte> place(const Room& room) const;
  Written commit(const Room& room, std::size_t size);
  [[nodiscard]] std::size_t offset(std::uint64_t position) const {
    return (position - origin_) & (ring_.data.size() - 1);
  }

  Ring ring_;
  std::uint64_t written_ = 0;
  std::uint64_t origin_ = 0;
};

/// The reading side of a ring that is fresh.
///
/// Thread contract: one thread at a time; has_news() from any.
class RingReader {
 public:
  explicit RingReader(const Ring& ring) : ring_(ring) {}
  /// Goes on with another ring, which is fresh.
  void take_over(const Ring& ring);

  /// Returns whether something has been written since it was last read, or the ring was closed.
  [[nodiscard]] bool has_news() const {
    return ring_.control->written.load(std::memory_order_acquire) != read_.load(std::memory_order_relaxed) ||
           is_closed();
  }
  [[nodiscard]] bool is_closed() const { return ring_.control->closed.load(std::memory_order_acquire) != 0; }

  /// Fixes the end up to which next() goes: what has been written by now.
  /// @errors  data_loss if the writer's position or the origin cannot be.
  Status look();
  /// Returns the next record, valid until release(); nothing at the end.
  /// @errors  data_loss if its length cannot be.
  Result<std::optional<std::span<const std::byte>>> next();
  /// Gives the memory of the record back to the writer.
  void release();
  /// Returns whether the writer waits for room. Asked after release(), no waiting writer is overlooked.
  [[nodiscard]] bool writer_waits() const {
    return ring_.control->writer_waits.load(std::memory_order_seq_cst) != 0;
  }

 private:
  Ring ring_;
  std::atomic<std::uint64_t> read_{0};
  std::uint64_t origin_ = 0;
  std::uint64_t end_ = 0;
  std::uint64_t after_ = 0;  // position behind the record that next() has returned
};

}  // namespace orca::shm
