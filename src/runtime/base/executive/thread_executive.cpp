// SPDX-License-Identifier: LGPL-3.0-or-later
#include "thread_executive.hpp"

#include <pthread.h>

#include <thread>

#include "futex_event.hpp"
#include "steady_time.hpp"

namespace orca::detail {
namespace {

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
  FutexEvent ended_{Duration{0}};
  bool has_ended_ = false;
  std::thread thread_;
};

}  // namespace

TimePoint ThreadExecutive::now() const { return steady_now(); }

std::unique_ptr<Event> ThreadExecutive::make_event() { return std::make_unique<FutexEvent>(spin_); }

std::unique_ptr<Task> ThreadExecutive::spawn(TaskOptions options, std::function<void()> body) {
  return std::make_unique<ThreadTask>(options, std::move(body));
}

void ThreadExecutive::run(std::function<void()> main) { main(); }

std::optional<StuckTask> ThreadExecutive::stuck_task(Duration /*limit*/) { return std::nullopt; }

}  // namespace orca::detail
