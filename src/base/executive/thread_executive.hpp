// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/executive.hpp"
#include "thread_watch.hpp"

namespace orca::detail {

/// An executive with one std::thread per task, on the steady clock.
class ThreadExecutive final : public Executive {
 public:
  explicit ThreadExecutive(Duration spin) : spin_(spin) {}

  [[nodiscard]] TimePoint now() const override;
  [[nodiscard]] bool is_virtual() const override { return false; }
  [[nodiscard]] bool tasks_overlap() const override { return true; }
  [[nodiscard]] std::unique_ptr<Event> make_event() override;
  [[nodiscard]] std::unique_ptr<InputEvent> make_input_event() override;
  [[nodiscard]] std::unique_ptr<Event> make_doorbell_event(DoorbellWord& own) override;
  [[nodiscard]] std::unique_ptr<Task> spawn(TaskOptions options, std::function<void()> body) override;
  void run(std::function<void()> main) override;
  [[nodiscard]] std::optional<StuckTask> stuck_task(Duration limit) override;

 private:
  const Duration spin_;
  ThreadWatch watch_;
};

}  // namespace orca::detail
