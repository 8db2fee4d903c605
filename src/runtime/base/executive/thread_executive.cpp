// SPDX-License-Identifier: LGPL-3.0-or-later
#include "thread_executive.hpp"

#include <pthread.h>

#include <condition_variable>
#include <mutex>
#include <thread>

#include "steady_time.hpp"

namespace orca::detail {
namespace {

class ThreadEvent final : public Event {
 public:
  void notify() override {
    // Notified under the lock: the waiter may destroy the event as soon as it returns.
    const std::lock_guard lock(mutex_);
    notified_ = true;
    condition_.notify_one();
  }

  bool wait_until(TimePoint deadline) override {
    std::unique_lock lock(mutex_);
    const auto notified = [this] { return notified_; };
    if (deadline == kForever) {
      condition_.wait(lock, notified);
    } else if (!condition_.wait_until(lock, to_steady(deadline), notified)) {
      return false;
    }
    notified_ = false;
    return true;
  }

 private:
  std::mutex mutex_;
  std::condition_variable condition_;
  bool notified_ = false;
};

class ThreadTask final : public Task {
 public:
  ThreadTask(const TaskOptions& options, std::function<void()> body)
      : thread_([this, name = options.name.substr(0, 15), run = std::move(body)] {
          pthread_setname_np(pthread_self(), name.c_str());
          run();
          ended_.notify();
        }) {}
  ~ThreadTask() override { thread_.join(); }

  bool join_until(TimePoint deadline) override {
    if (!has_ended_) has_ended_ = ended_.wait_until(deadline);
    return has_ended_;
  }

 private:
  ThreadEvent ended_;
  bool has_ended_ = false;
  std::thread thread_;
};

}  // namespace

TimePoint ThreadExecutive::now() const { return steady_now(); }

std::unique_ptr<Event> ThreadExecutive::make_event() { return std::make_unique<ThreadEvent>(); }

std::unique_ptr<Task> ThreadExecutive::spawn(TaskOptions options, std::function<void()> body) {
  return std::make_unique<ThreadTask>(options, std::move(body));
}

void ThreadExecutive::run(std::function<void()> main) { main(); }

std::optional<StuckTask> ThreadExecutive::stuck_task(Duration /*limit*/) { return std::nullopt; }

}  // namespace orca::detail
