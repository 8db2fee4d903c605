// SPDX-License-Identifier: LGPL-3.0-or-later
/// @file
/// A mutex, its lock, and words that say what a mutex guards. The lint check `threads` has clang prove that guarded members
/// are used under their mutex only; gcc ignores the words.
#pragma once

#include <mutex>

#if defined(__clang__)
#define ORCA_THREAD_WORD(word) __attribute__((word))
#else
#define ORCA_THREAD_WORD(word)
#endif
/// After a member: it is read and written only while the mutex is held.
#define ORCA_GUARDED_BY(mutex) ORCA_THREAD_WORD(guarded_by(mutex))
/// After a function, or the parameters of a lambda: its caller holds the mutex.
#define ORCA_REQUIRES(mutex) ORCA_THREAD_WORD(requires_capability(mutex))
/// After a function that takes a mutex, tries to take it, or gives it back.
#define ORCA_ACQUIRES(...) ORCA_THREAD_WORD(acquire_capability(__VA_ARGS__))
#define ORCA_TRIES_TO_ACQUIRE(...) ORCA_THREAD_WORD(try_acquire_capability(true __VA_OPT__(, ) __VA_ARGS__))
#define ORCA_RELEASES(...) ORCA_THREAD_WORD(release_capability(__VA_ARGS__))

namespace orca {

/// A std::mutex that clang can follow.
///
/// Thread contract: as std::mutex.
class ORCA_THREAD_WORD(capability("mutex")) Mutex : public std::mutex {
 public:
  using Native = std::mutex;

  void lock() ORCA_ACQUIRES() { std::mutex::lock(); }
  [[nodiscard]] bool try_lock() ORCA_TRIES_TO_ACQUIRE() { return std::mutex::try_lock(); }
  void unlock() ORCA_RELEASES() { std::mutex::unlock(); }
};

/// A lock that holds a mutex until it is destroyed, and may give it back for a while.
///
/// Thread contract: one thread.
template <class AnyMutex>
class ORCA_THREAD_WORD(scoped_lockable) MutexLock {
 public:
  explicit MutexLock(AnyMutex& mutex) ORCA_ACQUIRES(mutex) : lock_(mutex) {}
  /// Takes over a mutex that the caller holds already.
  MutexLock(AnyMutex& mutex, std::adopt_lock_t held) ORCA_REQUIRES(mutex) : lock_(mutex, held) {}
  MutexLock(const MutexLock&) = delete;
  MutexLock& operator=(const MutexLock&) = delete;
  ~MutexLock() ORCA_RELEASES() {}  // NOLINT(modernize-use-equals-default): it would lose the word

  void lock() ORCA_ACQUIRES() { lock_.lock(); }
  void unlock() ORCA_RELEASES() { lock_.unlock(); }
  /// Returns the lock for std::condition_variable, which holds the mutex again when its wait returns.
  [[nodiscard]] std::unique_lock<typename AnyMutex::Native>& native() { return lock_; }

 private:
  std::unique_lock<typename AnyMutex::Native> lock_;
};

}  // namespace orca
