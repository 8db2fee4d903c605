// SPDX-License-Identifier: LGPL-3.0-or-later
#include "thread_executive.hpp"

#include <pthread.h>

#include <condition_variable>
#include <mutex>
#include <thread>

#include "steady_time.hpp"

namespace orca::detail {
namespace {

// Of the task that runs on this thread, if any.
thread_local Stopwatch* t_stopwatch = nullptr;

std::int64_t steady_ns() { return steady_now().time_since_epoch().count(); }

// Stops the watch as long as the task waits.
class Pause {
 public:
  Pause() {
    if (t_stopwatch != nullptr) t_stopwatch->busy_since_ns.store(0, std::memory_order_relaxed);
  }
  ~Pause() {
    if (t_stopwatch != nullptr) t_stopwatch->busy_since_ns.store(steady_ns(), std::memory_order_relaxed);
  }
  Pause(const Pause&) = delete;
  Pause& operator=(const Pause&) = delete;
};

class ThreadEvent final : public Event {
 public:
  void notify() override {
    // Notified under the lock: the waiter may destroy the event as soon as it returns.
    const std::lock_guard lock(mutex_);
    notified_ = true;
    condition_.notify_one();
  }

  bool wait_until(TimePoint deadline) override {
    const Pause pause;
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
  ThreadTask(ThreadExecutive& executive, const TaskOptions& options, std::function<void()> body)
      : executive_(executive), stopwatch_{options.name, {}} {
    executive_.watch(stopwatch_);
    thread_ = std::thread([this, run = std::move(body)] {
      pthread_setname_np(pthread_self(), stopwatch_.name.substr(0, 15).c_str());
      t_stopwatch = &stopwatch_;
      stopwatch_.busy_since_ns = steady_ns();
      run();
      stopwatch_.busy_since_ns = 0;
      ended_.notify();
    });
  }
  ~ThreadTask() override {
    thread_.join();
    executive_.forget(stopwatch_);
  }

  bool join_until(TimePoint deadline) override {
    if (!has_ended_) has_ended_ = ended_.wait_until(deadline);
    return has_ended_;
  }

 private:
  ThreadExecutive& executive_;
  Stopwatch stopwatch_;
  ThreadEvent ended_;
  bool has_ended_ = false;
  std::thread thread_;
};

}  // namespace

TimePoint ThreadExecutive::now() const { return steady_now(); }

std::unique_ptr<Event> ThreadExecutive::make_event() { return std::make_unique<ThreadEvent>(); }

std::unique_ptr<Task> ThreadExecutive::spawn(TaskOptions options, std::function<void()> body) {
  return std::make_unique<ThreadTask>(*this, options, std::move(body));
}

void ThreadExecutive::run(std::function<void()> main) { main(); }

std::optional<StuckTask> ThreadExecutive::stuck_task(Duration limit) {
  const std::lock_guard lock(mutex_);
  const std::int64_t now = steady_ns();
  std::optional<StuckTask> latest;  // it is the one that nobody has heard of yet
  std::int64_t latest_since = 0;
  for (const Stopwatch* stopwatch : stopwatches_) {
    const std::int64_t since = stopwatch->busy_since_ns.load(std::memory_order_relaxed);
    if (since <= latest_since || now - since <= limit.count()) continue;
    latest = StuckTask{stopwatch->name, false, false};
    latest_since = since;
  }
  return latest;
}

void ThreadExecutive::watch(const Stopwatch& stopwatch) {
  const std::lock_guard lock(mutex_);
  stopwatches_.push_back(&stopwatch);
}

void ThreadExecutive::forget(const Stopwatch& stopwatch) {
  const std::lock_guard lock(mutex_);
  std::erase(stopwatches_, &stopwatch);
}

}  // namespace orca::detail
