// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

namespace orca::bench {

/// A ring of pointers from one thread to another, which sleeps on a futex while the ring is empty.
class FutexRing {
 public:
  void put(void* object);
  void* take();

 private:
  static constexpr std::uint32_t kPlaces = 64;
  std::array<void*, kPlaces> places_{};
  std::atomic<std::uint32_t> put_{0};    // the reader sleeps on it
  std::atomic<std::uint32_t> taken_{0};  // by the reader
  std::atomic<bool> asleep_{false};      // written by the reader only
};

/// Two threads that pass a pointer to each other through two rings.
class FutexRingPair {
 public:
  FutexRingPair();
  ~FutexRingPair();
  /// @return time from one thread to the other [ns].
  double time(int round_trips);

 private:
  FutexRing there_;
  FutexRing back_;
  std::thread echo_;
};

/// Two threads that ask and answer through one mutex and two condition variables.
class ConditionPair {
 public:
  ConditionPair();
  ~ConditionPair();
  /// @return time of one question with its answer [ns].
  double time(int questions);

 private:
  int ask(int question);
  void answer_all();

  std::mutex mutex_;
  std::condition_variable asked_;
  std::condition_variable answered_;
  int question_ = 0;  // 0: none, negative: the end
  int answer_ = 0;    // 0: none
  std::thread answerer_;
};

}  // namespace orca::bench
