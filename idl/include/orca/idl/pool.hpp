// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <type_traits>

#include "orca/base/mutex.hpp"
#include "orca/idl/object.hpp"

namespace orca::detail {

/// The memory of all objects of one type: slabs of slots, which grow in size and are never freed. A recycled
/// slot keeps its object constructed, so that texts and sequences keep their capacity.
///
/// Thread contract: any thread.
class Pool {
 public:
  constexpr explicit Pool(const ObjectType& type) : type_(type) {}
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  /// Returns a slot with one reference, whose object has its default value.
  [[nodiscard]] Slot* acquire() noexcept;
  void recycle(Slot* slot) noexcept;
  [[nodiscard]] PoolStatistics statistics();

  /// Keep other threads out while the process is copied (fork), so that the copy finds the pool whole and free.
  void lock() ORCA_ACQUIRES(mutex_) { mutex_.lock(); }
  void unlock() ORCA_RELEASES(mutex_) { mutex_.unlock(); }

 private:
  struct Slab {
    Slab* next;
  };

  void grow() ORCA_REQUIRES(mutex_);
  void take_back() ORCA_REQUIRES(mutex_);
  [[nodiscard]] std::size_t stride() const;

  const ObjectType& type_;
  std::atomic<Slot*> returned_{nullptr};  // recycled, but not yet among the free slots
  Mutex mutex_;
  Slot* free_ ORCA_GUARDED_BY(mutex_) = nullptr;
  Slab* slabs_ ORCA_GUARDED_BY(mutex_) = nullptr;        // Keeps the memory reachable for leak checkers.
  const void* blank_ ORCA_GUARDED_BY(mutex_) = nullptr;  // A default object; constant once made.
  std::size_t capacity_ ORCA_GUARDED_BY(mutex_) = 0;
};

// Views may be dropped while the program's static objects are destroyed, so a pool must outlast them all.
static_assert(std::is_trivially_destructible_v<Pool>);

}  // namespace orca::detail
