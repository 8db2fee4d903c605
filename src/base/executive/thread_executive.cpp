// SPDX-License-Identifier: LGPL-3.0-or-later
#include "thread_executive.hpp"

#include <pthread.h>

#include <thread>

#include "futex_event.hpp"
#include "input_event.hpp"
#include "orca/base/steady_clock.hpp"
#include "task_thread.hpp"

namespace orca::detail {
namespace {

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
