// SPDX-License-Identifier: LGPL-3.0-or-later
#include "thread_executive.hpp"

#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <ctime>
#include <system_error>
#include <thread>

#include "futex_event.hpp"
#include "orca/base/steady_clock.hpp"
#include "sanitizer.hpp"
#include "task_thread.hpp"
#include "thread_watch.hpp"

namespace orca::detail {
namespace {

// An InputEvent between threads. It makes a system call only when a thread sleeps or must be woken, and to look at the
// descriptor.
//
// Thread contract: as InputEvent.
class ThreadInputEvent final : public InputEvent {
 public:
  // @errors  throws std::system_error if the system has no more descriptors.
  ThreadInputEvent();
  ~ThreadInputEvent() override;

  void notify() override;
  bool wait_until(TimePoint deadline) override;
  void watch(int descriptor) override { watched_ = descriptor; }

 private:
  bool take();
  bool poll_until(TimePoint deadline);
  void drain();

  std::atomic<std::uint32_t> state_{0};
  const int bell_;    // an eventfd
  int watched_ = -1;  // used by the waiter only
};

// As those of FutexEvent: only the waiter sets kAsleep.
enum InputState : std::uint32_t { kNoNews, kNews, kPolling };

timespec time_left(TimePoint deadline) {
  const auto left = std::max(deadline - steady_now(), Duration{0});
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
  return {seconds.count(), (left - seconds).count()};
}

ThreadInputEvent::ThreadInputEvent() : bell_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  if (bell_ < 0) throw std::system_error(errno, std::generic_category(), "no event for input");
}

ThreadInputEvent::~ThreadInputEvent() { close(bell_); }

void ThreadInputEvent::notify() {
  if (state_.exchange(kNews, std::memory_order_acq_rel) != kPolling) return;
  const std::uint64_t one = 1;
  (void)!write(bell_, &one, sizeof one);
}

bool ThreadInputEvent::wait_until(TimePoint deadline) {
  const Waiting waiting;
  if (take()) return true;
  for (;;) {
    std::uint32_t seen = kNoNews;
    if (!state_.compare_exchange_strong(seen, kPolling, std::memory_order_acq_rel)) return take();
    const bool has_input = poll_until(deadline);
    const bool notified = state_.exchange(kNoNews, std::memory_order_acq_rel) == kNews;
    if (notified || has_input) return true;
    if (deadline != kForever && steady_now() >= deadline) return false;
  }
}

bool ThreadInputEvent::take() {
  return state_.load(std::memory_order_relaxed) == kNews &&
         state_.exchange(kNoNews, std::memory_order_acquire) == kNews;
}

// Sleeps until there is news or the deadline comes, or for a shorter time: a ring may come late, when its news is known
// already. Returns whether the descriptor has input or has failed; a read shows which.
bool ThreadInputEvent::poll_until(TimePoint deadline) {
  if constexpr (kLongestSleep != Duration::max()) deadline = std::min(deadline, steady_now() + kLongestSleep);
  pollfd news[] = {{bell_, POLLIN, 0}, {watched_, POLLIN, 0}};  // a negative one is left out
  const timespec left = deadline == kForever ? timespec{} : time_left(deadline);
  const int count = ppoll(news, 2, deadline == kForever ? nullptr : &left, nullptr);
  let_signals_be_handled();
  if (count <= 0) return false;
  if (news[0].revents != 0) drain();
  return news[1].revents != 0;
}

void ThreadInputEvent::drain() {
  std::uint64_t rings = 0;
  (void)!read(bell_, &rings, sizeof rings);
}

class ThreadTask final : public Task {
 public:
  ThreadTask(const Executive& executive, ThreadWatch& watch, const TaskOptions& options,
             std::function<void()> body)
      : watch_(watch), waits_(options.name) {
    watch_.add(waits_);
    try {
      thread_ = std::thread([this, &executive, run = std::move(body)] {
        const TaskThread here(executive);
        pthread_setname_np(pthread_self(), waits_.name().substr(0, 15).c_str());
        waits_.attach();
        run();
        waits_.begin();  // never ends: the task is over
        ended_.notify();
      });
    } catch (...) {  // the system gives no more threads
      watch_.remove(waits_);
      throw;
    }
  }
  ~ThreadTask() override {
    thread_.join();
    watch_.remove(waits_);
  }

  bool join_until(TimePoint deadline) override {
    if (!has_ended_) has_ended_ = ended_.wait_until(deadline);
    return has_ended_;
  }

 private:
  ThreadWatch& watch_;
  WaitCount waits_;
  FutexEvent ended_{Duration{0}};
  bool has_ended_ = false;
  std::thread thread_;
};

}  // namespace

TimePoint ThreadExecutive::now() const { return steady_now(); }

std::unique_ptr<Event> ThreadExecutive::make_event() { return std::make_unique<FutexEvent>(spin_); }

std::unique_ptr<InputEvent> ThreadExecutive::make_input_event() {
  return std::make_unique<ThreadInputEvent>();
}

std::unique_ptr<Event> ThreadExecutive::make_doorbell_event(DoorbellWord& own) {
  return std::make_unique<FutexEvent>(spin_, &own);
}

std::unique_ptr<Task> ThreadExecutive::spawn(TaskOptions options, std::function<void()> body) {
  return std::make_unique<ThreadTask>(*this, watch_, options, std::move(body));
}

void ThreadExecutive::run(std::function<void()> main) {
  const TaskThread here(*this);
  main();
}

std::optional<StuckTask> ThreadExecutive::stuck_task(Duration limit) { return watch_.stuck_task(limit); }

}  // namespace orca::detail
