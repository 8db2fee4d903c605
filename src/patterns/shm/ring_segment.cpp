// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/shm/ring_segment.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include "orca/idl/bulk_pool.hpp"
#include "ring.hpp"

namespace orca {
namespace {

constexpr std::size_t kLeast = 4096;                 // [bytes]
constexpr std::size_t kMost = std::size_t{1} << 30;  // [bytes]

bool is_possible(std::size_t capacity) {
  return capacity >= kLeast && capacity <= kMost && std::has_single_bit(capacity);
}

}  // namespace

Result<MemoryFile> RingSegment::create(const std::string& edge, std::size_t capacity) {
  if (capacity > kMost)
    return fail(Code::invalid_argument, "a ring of " + std::to_string(capacity) + " bytes; at most " +
                                            std::to_string(kMost) + " are possible");
  const std::size_t rounded = std::bit_ceil(std::max(capacity, kLeast));
  return MemoryFile::create("orca " + edge, shm::kControlSize + 2 * rounded);
}

Result<RingSegment> RingSegment::map(int descriptor) {
  Result<SharedMemory> memory = SharedMemory::map(descriptor);
  if (!memory) return memory.error();
  RingSegment segment(std::move(memory).value());
  const std::size_t size = segment.memory().bytes().size();
  if (size <= shm::kControlSize || !is_possible(segment.capacity()) ||
      size != shm::kControlSize + 2 * segment.capacity())
    return fail(Code::invalid_argument,
                "a memory file of " + std::to_string(size) + " bytes holds no two rings");
  return segment;
}

std::size_t RingSegment::capacity() const { return (memory_->bytes().size() - shm::kControlSize) / 2; }

std::uint64_t RingSegment::written_by_client() const {
  return shm::ring_in(memory_->bytes(), 0).control->written.load(std::memory_order_relaxed);
}

Result<MemoryFile> create_bulk_pool(const std::string& process) {
  return MemoryFile::create("orca bulk data of " + process, kBulkPoolSize, MemoryFile::Writers::owner);
}

}  // namespace orca
