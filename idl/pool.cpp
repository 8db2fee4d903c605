// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/idl/pool.hpp"

#include <pthread.h>

#include <algorithm>
#include <new>
#include <utility>

#include "orca/idl/object_library.hpp"

namespace orca {
namespace detail {
namespace {

// ThreadSanitizer does not follow copies of a process, and follows 64 locks at once.
#if !defined(__SANITIZE_THREAD__)
void lock_all() ORCA_THREAD_WORD(no_thread_safety_analysis) {
  lock_object_types();  // so that the same pools are unlocked
  for (const ObjectType* const type : object_types()) type->pool.lock();
}
void unlock_all() ORCA_THREAD_WORD(no_thread_safety_analysis) {
  for (const ObjectType* const type : object_types()) type->pool.unlock();
  unlock_object_types();
}

[[maybe_unused]] const int g_registered = pthread_atfork(lock_all, unlock_all, unlock_all);
#endif

constexpr std::size_t kFirstSlab = 16;
constexpr std::size_t kLargestSlab = 1024;

constexpr std::size_t round_up(std::size_t size, std::size_t align) {
  return (size + align - 1) / align * align;
}

std::size_t slot_align(const ObjectType& type) {
  return std::max({type.align, alignof(Slot), alignof(std::max_align_t)});
}

std::size_t object_offset(const ObjectType& type) { return round_up(sizeof(Slot), type.align); }

}  // namespace

std::size_t Pool::stride() const { return round_up(object_offset(type_) + type_.size, slot_align(type_)); }

void Pool::grow() {
  // The first slab has one more place, for the blank object.
  const bool first = slabs_ == nullptr;
  const std::size_t places = std::clamp(capacity_, kFirstSlab, kLargestSlab);
  const std::size_t head = round_up(sizeof(Slab), slot_align(type_));
  const std::size_t bytes = head + (places + (first ? 1 : 0)) * stride();
  auto* memory = static_cast<std::byte*>(::operator new (bytes, std::align_val_t{slot_align(type_)}));
  slabs_ = new (memory) Slab{slabs_};
  for (std::byte* place = memory + head; place != memory + bytes; place += stride()) {
    void* object = place + object_offset(type_);
    type_.construct(object);
    if (blank_ == nullptr) {
      blank_ = object;
      continue;
    }
    free_ = new (place)
        Slot{.type = &type_, .object = object, .header = &type_.header(object), .next_free = free_};
  }
  capacity_ += places;
}

Slot* Pool::acquire() noexcept {
  Slot* slot = nullptr;
  const void* blank = nullptr;
  {
    const MutexLock lock(mutex_);
    take_back();
    if (free_ == nullptr) grow();
    slot = free_;
    free_ = slot->next_free;
    blank = blank_;
  }
  type_.assign(slot->object, blank);
  slot->references.store(1, std::memory_order_relaxed);
  return slot;
}

// The slots returned last come first, because they may still be in the caches.
void Pool::take_back() {
  if (returned_.load(std::memory_order_relaxed) == nullptr) return;
  Slot* slot = returned_.exchange(nullptr, std::memory_order_acquire);
  while (slot != nullptr) slot = std::exchange(slot->next_free, std::exchange(free_, slot));
}

// Takes no lock, so that dropping the last view of an object never waits. Only take_back() removes slots from
// the list, and all at once. So it does not matter whether the first slot has left the list and come back
// since it was read.
void Pool::recycle(Slot* slot) noexcept {
  if (type_.bulk != nullptr) type_.bulk->let_go(slot->object);
  slot->next_free = returned_.load(std::memory_order_relaxed);
  while (!returned_.compare_exchange_weak(slot->next_free, slot, std::memory_order_release,
                                          std::memory_order_relaxed)) {
  }
}

PoolStatistics Pool::statistics() {
  const MutexLock lock(mutex_);
  take_back();
  std::size_t live = capacity_;
  for (const Slot* slot = free_; slot != nullptr; slot = slot->next_free) --live;
  return {live, capacity_};
}

Slot* acquire_slot(const ObjectType& type) noexcept { return type.pool.acquire(); }

void release_slot(Slot* slot) noexcept {
  // Release: the reads through this view are complete before the object can be reused. Acquire: the last view
  // sees the same for all others. The last view needs no atomic subtraction, because no other view exists to
  // be copied or dropped.
  if (slot->references.load(std::memory_order_acquire) == 1 ||
      slot->references.fetch_sub(1, std::memory_order_acq_rel) == 1)
    slot->type->pool.recycle(slot);
}

}  // namespace detail

ObjectLoan make_object(const ObjectType& type) { return ObjectLoan(detail::acquire_slot(type)); }

ObjectLoan copy_value(const ObjectRef& original) {
  ObjectLoan copy = make_object(original.type());
  original.type().assign(copy.get(), original.get());
  return copy;
}

PoolStatistics pool_statistics(const ObjectType& type) { return type.pool.statistics(); }

}  // namespace orca
