// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/team.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <new>
#include <system_error>
#include <thread>

#include "executive/futex_event.hpp"
#include "orca/base/activity.hpp"
#include "orca/base/mutex.hpp"

namespace orca {
namespace {

using detail::useful_spin;

// Loops often follow each other closely, and a sleeping thread wakes late.
constexpr Duration kSpin = std::chrono::microseconds{300};

}  // namespace

// One loop in progress. It lives on the caller's stack: the caller waits for all helpers that have joined.
class Team::Loop {
 public:
  Loop(std::size_t count, const std::function<void(std::size_t)>& work) : count_(count), work_(work) {
    caller_.keep();
  }

  void share() {
    caller_.restore();
    for (;;) {
      const std::size_t i = next_.fetch_add(1, std::memory_order_relaxed);
      if (i >= count_) return;
      try {
        work_(i);
      } catch (...) {
        fail(i);
      }
    }
  }

  void finish() {
    const MutexLock lock(mutex_);
    if (failure_) std::rethrow_exception(failure_);
  }

  int helpers = 0;  // Helpers that have joined and not left; guarded by the team.

 private:
  void fail(std::size_t i) {
    const MutexLock lock(mutex_);
    if (failure_ && failed_ < i) return;
    failure_ = std::current_exception();
    failed_ = i;
  }

  std::size_t count_;
  const std::function<void(std::size_t)>& work_;
  ActivityKeeper caller_;  // A helper works in the name of the caller.
  std::atomic<std::size_t> next_{0};
  Mutex mutex_;
  std::exception_ptr failure_ ORCA_GUARDED_BY(mutex_);
  std::size_t failed_ ORCA_GUARDED_BY(mutex_) = 0;
};

struct Team::Helper {
  detail::FutexEvent loop_begins{useful_spin(kSpin)};
  std::thread thread;
};

Team::Team(unsigned threads) : helpers_left_(std::make_unique<detail::FutexEvent>(useful_spin(kSpin))) {
  const unsigned wanted = threads > 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
  helpers_.reserve(wanted - 1);  // Nothing can fail between a thread's start and its place here.
  try {
    while (helpers_.size() + 1 < wanted) {
      auto helper = std::make_unique<Helper>();
      helper->thread = std::thread([this, &self = *helper] { help(self); });
      helpers_.push_back(std::move(helper));
    }
  } catch (const std::system_error&) {
    // The team has as many threads as the system allows.
  } catch (const std::bad_alloc&) {
    // The team has as many threads as there is memory for.
  }
}

Team::~Team() {
  {
    const MutexLock lock(mutex_);
    ended_ = true;
  }
  wake_helpers();
  for (const auto& helper : helpers_) helper->thread.join();
}

void Team::for_all(std::size_t count, const std::function<void(std::size_t)>& work) {
  Loop loop(count, work);
  if (count > 1 && !helpers_.empty()) {
    {
      const MutexLock lock(mutex_);
      loop_ = &loop;
    }
    wake_helpers();
  }
  loop.share();
  wait_for_helpers(loop);
  loop.finish();
}

void Team::wake_helpers() {
  for (const auto& helper : helpers_) helper->loop_begins.notify();
}

void Team::wait_for_helpers(const Loop& loop) {
  for (;;) {
    {
      const MutexLock lock(mutex_);
      loop_ = nullptr;  // A late helper need not join.
      if (loop.helpers == 0) return;
    }
    helpers_left_->wait_until(kForever);
  }
}

void Team::help(Helper& self) {
  for (;;) {
    self.loop_begins.wait_until(kForever);
    MutexLock lock(mutex_);
    if (ended_) return;
    if (loop_ == nullptr) continue;
    Loop& loop = *loop_;
    ++loop.helpers;
    lock.unlock();
    loop.share();
    ActivityKeeper{}.restore();
    lock.lock();
    if (--loop.helpers == 0) helpers_left_->notify();
  }
}

}  // namespace orca
