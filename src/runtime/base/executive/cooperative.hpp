// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <set>
#include <tuple>
#include <vector>

#include "context.hpp"
#include "orca/base/executive.hpp"

namespace orca::detail {

class CooperativeEvent;

/// Schedules tasks one at a time: on fibers, or on threads that hand a baton around. The scheduling is the
/// same for both, so their order is the same.
class CooperativeExecutive final : public Executive {
 public:
  CooperativeExecutive(ClockKind clock, ContextFactory make_context);
  ~CooperativeExecutive() override;

  [[nodiscard]] TimePoint now() const override;
  [[nodiscard]] bool is_virtual() const override { return clock_ == ClockKind::virtual_time; }
  [[nodiscard]] std::unique_ptr<Event> make_event() override;
  [[nodiscard]] std::unique_ptr<Task> spawn(TaskOptions options, std::function<void()> body) override;
  void run(std::function<void()> main) override;
  [[nodiscard]] std::optional<StuckTask> stuck_task(Duration limit) override;

  struct Fiber;

  // For CooperativeEvent.
  void block_until(TimePoint deadline);
  void make_ready(Fiber& fiber);
  [[nodiscard]] Fiber* current() { return current_; }
  [[nodiscard]] bool called_from_inside() const;
  void post_notification(CooperativeEvent& event);
  void forget_notifications(CooperativeEvent& event);

  // For CooperativeTask.
  void destroy(std::unique_ptr<Fiber> fiber);

 private:
  // Ordered as DESIGN asks: time, then priority (larger first), then sequence.
  using Key = std::tuple<TimePoint, int, std::uint64_t, Fiber*>;
  using Queue = std::set<Key>;

  [[nodiscard]] bool sleeps_too_long(const Fiber& fiber, Duration limit);
  std::unique_ptr<Fiber> make_fiber(TaskOptions options, std::function<void()> body);
  void run_one();
  static void enqueue(Queue& queue, Queue::node_type& place, const Key& key);
  void take_notifications();
  void fire_timers();
  void wait_for_work();
  void advance_virtual_time();

  const ClockKind clock_;
  const ContextFactory make_context_;
  std::atomic<std::int64_t> virtual_now_ns_{0};

  // Touched only by the thread that schedules or holds the baton.
  Queue ready_;
  Queue timers_;
  std::uint64_t sequence_ = 0;
  Fiber* current_ = nullptr;
  Fiber* main_ = nullptr;

  // From other threads.
  std::mutex inbox_mutex_;
  std::condition_variable inbox_changed_;
  std::vector<CooperativeEvent*> inbox_;
  std::atomic<bool> inbox_filled_{false};

  // For the monitor. A fiber is destroyed under monitor_mutex_, so that its name can be read.
  std::mutex monitor_mutex_;
  std::atomic<const Fiber*> running_{nullptr};
  std::atomic<std::uint64_t> switches_{0};
  std::uint64_t observed_switches_ = 0;
  Duration cpu_at_observation_{0};
  TimePoint awake_at_{};  // when the running task was last seen to do something
};

}  // namespace orca::detail
