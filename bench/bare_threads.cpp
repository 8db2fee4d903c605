// SPDX-License-Identifier: GPL-3.0-or-later
#include "bare_threads.hpp"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "comparison.hpp"

namespace orca::bench {

void FutexRing::put(void* object) {
  const std::uint32_t place = put_.load(std::memory_order_relaxed);
  places_[place % kPlaces] = object;
  put_.store(place + 1, std::memory_order_seq_cst);
  if (asleep_.load(std::memory_order_seq_cst))
    syscall(SYS_futex, &put_, FUTEX_WAKE_PRIVATE, 1, nullptr, nullptr, 0);
}

void* FutexRing::take() {
  const std::uint32_t place = taken_.load(std::memory_order_relaxed);
  if (put_.load(std::memory_order_acquire) == place) {
    asleep_.store(true, std::memory_order_seq_cst);
    while (put_.load(std::memory_order_seq_cst) == place)
      syscall(SYS_futex, &put_, FUTEX_WAIT_PRIVATE, place, nullptr, nullptr, 0);
    asleep_.store(false, std::memory_order_relaxed);
  }
  taken_.store(place + 1, std::memory_order_release);
  return places_[place % kPlaces];
}

FutexRingPair::FutexRingPair()
    : echo_([this] {
        while (void* object = there_.take()) back_.put(object);
      }) {}

FutexRingPair::~FutexRingPair() {
  there_.put(nullptr);
  echo_.join();
}

double FutexRingPair::time(int round_trips) {
  int object = 0;
  return time_per_operation(2 * round_trips, [&] {
    for (int i = 0; i < round_trips; ++i) {
      there_.put(&object);
      benchmark::DoNotOptimize(back_.take());
    }
  });
}

ConditionPair::ConditionPair() : answerer_([this] { answer_all(); }) {}

ConditionPair::~ConditionPair() {
  {
    const std::lock_guard lock(mutex_);
    question_ = -1;
  }
  asked_.notify_one();
  answerer_.join();
}

void ConditionPair::answer_all() {
  for (;;) {
    std::unique_lock lock(mutex_);
    asked_.wait(lock, [this] { return question_ != 0; });
    if (question_ < 0) return;
    answer_ = question_ + 1;
    question_ = 0;
    lock.unlock();
    answered_.notify_one();
  }
}

int ConditionPair::ask(int question) {
  std::unique_lock lock(mutex_);
  question_ = question;
  answer_ = 0;
  lock.unlock();
  asked_.notify_one();
  lock.lock();
  answered_.wait(lock, [this] { return answer_ != 0; });
  return answer_;
}

double ConditionPair::time(int questions) {
  return time_per_operation(questions, [&] {
    for (int i = 1; i <= questions; ++i) benchmark::DoNotOptimize(ask(i));
  });
}

}  // namespace orca::bench
