// SPDX-License-Identifier: LGPL-3.0-or-later
#include "futex_event.hpp"

#include <linux/futex.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>

#include "orca/base/steady_clock.hpp"
#include "sanitizer.hpp"
#include "thread_watch.hpp"

namespace orca::detail {
namespace {

// Only the waiter sets kAsleep, and only the waiter leaves it at a timeout. Any other way out is a notification,
// so none is lost. Another process may write anything else into the word by mistake. It counts as a notification, too, and who
// rings next finds a word that may have been kAsleep, and wakes. So a sleeper misses a ring only if what was written happens to be
// kIdle or kNotified, which is why these are numbers that nobody writes by chance; zero is the word of nobody yet. Against the worst
// case a word of several processes counts as rung after kLongestTrust.
enum State : std::uint32_t { kIdle = 0x9c3b71d5, kNotified = 0x5ae40e8b, kAsleep = 0xc6d1a93e };

constexpr int kChecksPerClockReading = 32;
constexpr int kAllProcesses = 0;
constexpr Duration kLongestTrust = std::chrono::milliseconds(500);

void relax_processor() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

void futex(DoorbellWord& word, int operation, std::uint32_t value, const timespec* deadline) {
  syscall(SYS_futex, &word, operation, value, deadline, nullptr, FUTEX_BITSET_MATCH_ANY);
}

// The waiter may destroy the event, and with it a word of its own, as soon as it sees the flag. The wake-up then
// goes to an address where no thread sleeps, or where a later sleeper checks its own word again.
void notify_word(DoorbellWord& word, int scope) {
  const std::uint32_t before = word.exchange(kNotified, std::memory_order_acq_rel);
  if (before != kIdle && before != kNotified) futex(word, FUTEX_WAKE | scope, 1, nullptr);
}

timespec to_timespec(TimePoint time) {
  const auto since_boot = std::max(to_steady(time).time_since_epoch(), Duration{0});
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(since_boot);
  return {seconds.count(), (since_boot - seconds).count()};
}

// Sleeps until the word changes or the deadline comes, or for a shorter time.
void sleep_once(DoorbellWord& word, int scope, TimePoint deadline) {
  if constexpr (kLongestSleep != Duration::max()) deadline = std::min(deadline, steady_now() + kLongestSleep);
  const timespec limit = deadline == kForever ? timespec{} : to_timespec(deadline);
  futex(word, FUTEX_WAIT_BITSET | scope, kAsleep, deadline == kForever ? nullptr : &limit);
  let_signals_be_handled();
}

}  // namespace

FutexEvent::FutexEvent(Duration spin_limit, DoorbellWord* doorbell)
    : own_(kIdle),
      state_(doorbell != nullptr ? *doorbell : own_),
      scope_(doorbell != nullptr ? kAllProcesses : FUTEX_PRIVATE_FLAG),
      spin_limit_(spin_limit),
      spin_(spin_limit) {}

void FutexEvent::notify() { notify_word(state_, scope_); }

bool FutexEvent::wait_until(TimePoint deadline) {
  const Waiting waiting;
  if (take()) return true;
  return spin_limit_ > Duration{0} ? spin_then_sleep(deadline) : sleep(deadline);
}

bool FutexEvent::take() {
  return state_.load(std::memory_order_relaxed) != kIdle &&
         state_.exchange(kIdle, std::memory_order_acquire) != kIdle;
}

bool FutexEvent::spin_then_sleep(TimePoint deadline) {
  const TimePoint start = steady_now();
  const bool notified = (spin_ > Duration{0} && spin(std::min(deadline, start + spin_))) || sleep(deadline);
  // Twice the limit, because the time slept includes the time that waking took.
  spin_ = steady_now() - start <= 2 * spin_limit_ ? spin_limit_ : spin_ / 2;
  return notified;
}

bool FutexEvent::spin(TimePoint until) {
  do {
    for (int check = 0; check < kChecksPerClockReading; ++check) {
      if (take()) return true;
      relax_processor();
    }
  } while (steady_now() < until);
  return false;
}

bool FutexEvent::sleep(TimePoint deadline) {
  std::uint32_t seen = kIdle;
  const TimePoint look = scope_ == kAllProcesses ? steady_now() + kLongestTrust : kForever;
  const TimePoint end = std::min(deadline, look);
  (void)state_.compare_exchange_strong(seen, kAsleep, std::memory_order_acquire);  // it may be rung just now
  while (state_.load(std::memory_order_acquire) == kAsleep) {
    if (end != kForever && steady_now() >= end) {
      seen = kAsleep;
      if (state_.compare_exchange_strong(seen, kIdle, std::memory_order_acquire)) return look < deadline;
    } else {
      sleep_once(state_, scope_, end);
    }
  }
  (void)take();
  return true;
}

Duration useful_spin(Duration limit) {
  cpu_set_t usable;
  CPU_ZERO(&usable);
  const bool known = sched_getaffinity(0, sizeof usable, &usable) == 0;
  return known && CPU_COUNT(&usable) < 2 ? Duration{0} : limit;
}

}  // namespace orca::detail

void orca::ring(DoorbellWord& word) { detail::notify_word(word, detail::kAllProcesses); }
