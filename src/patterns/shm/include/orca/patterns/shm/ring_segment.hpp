// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "orca/base/result.hpp"
#include "orca/base/shared_memory.hpp"

namespace orca {

/// The shared memory of one edge between two processes: a ring each way. A fresh one, all zero, is two empty rings.
///
/// Thread contract: a handle; one thread at a time.
class RingSegment {
 public:
  /// The capacity of a ring if the graph says nothing else [bytes]. Memory is used only where it is written, and a
  /// quiet edge writes the beginning of its rings only.
  static constexpr std::size_t kDefaultCapacity = std::size_t{4} << 20;

  /// Makes the memory file of a segment.
  /// @param edge      for people: "a.out to b.in".
  /// @param capacity  of each ring [bytes], rounded up to a power of two of at least 4096. It is
  /// also the limit for an object, less about 50 bytes.
  /// @errors  invalid_argument for a capacity beyond 1 GiB; as MemoryFile::create().
  [[nodiscard]] static Result<MemoryFile> create(const std::string& edge,
                                                 std::size_t capacity = kDefaultCapacity);

  /// Maps a segment into this process. It must be fresh for both of its ends.
  /// @param descriptor  is not needed afterwards.
  /// @errors  invalid_argument if it is no file that create() has made.
  [[nodiscard]] static Result<RingSegment> map(int descriptor);

  /// Returns the capacity of each ring [bytes].
  [[nodiscard]] std::size_t capacity() const;
  [[nodiscard]] const SharedMemory& memory() const { return *memory_; }
  /// Returns the memory for whoever needs it longer than the segment.
  [[nodiscard]] std::shared_ptr<const SharedMemory> share() const { return memory_; }

  /// Returns how much the client of the edge has written so far [bytes], for whoever watches the edge and is no end of it:
  /// 0, it has used nothing of the server yet. The number is not checked.
  /// @thread  any.
  [[nodiscard]] std::uint64_t written_by_client() const;

 private:
  explicit RingSegment(SharedMemory memory)
      : memory_(std::make_shared<const SharedMemory>(std::move(memory))) {}

  std::shared_ptr<const SharedMemory> memory_;
};

/// Makes the memory file of a process's pool for bulk data (ADR 0104).
/// @errors  as MemoryFile::create().
[[nodiscard]] Result<MemoryFile> create_bulk_pool(const std::string& process);

}  // namespace orca
