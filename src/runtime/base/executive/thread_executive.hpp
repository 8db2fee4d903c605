// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "orca/base/executive.hpp"

namespace orca::detail {

/// Since when a task has not waited.
struct Stopwatch {
  std::string name;
  std::atomic<std::int64_t> busy_since_ns{0};  // of the steady clock; 0: it waits
};

/// One std::thread per task on the steady clock.
class ThreadExecutive final : public Executive {
 public:
  [[nodiscard]] TimePoint now() const override;
  [[nodiscard]] bool is_virtual() const override { return false; }
  [[nodiscard]] std::unique_ptr<Event> make_event() override;
  [[nodiscard]] std::unique_ptr<Task> spawn(TaskOptions options, std::function<void()> body) override;
  void run(std::function<void()> main) override;
  [[nodiscard]] std::optional<StuckTask> stuck_task(Duration limit) override;

  // For its tasks.
  void watch(const Stopwatch& stopwatch);
  void forget(const Stopwatch& stopwatch);

 private:
  std::mutex mutex_;
  std::vector<const Stopwatch*> stopwatches_;
};

}  // namespace orca::detail
