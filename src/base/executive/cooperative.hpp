// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <set>
#include <tuple>
#include <vector>

#include "context.hpp"
#include "futex_event.hpp"
#include "orca/base/executive.hpp"
#include "orca/base/system/pace.hpp"

namespace orca::detail {

class CooperativeEvent;

/// An executive that runs one task at a time, on fibers or on threads that pass a baton. Both schedule in the
/// same way, so the order of tasks is the same.
class CooperativeExecutive final : public Executive {
 public:
  /// @param pace  of virtual time; null: as fast as it can.
  CooperativeExecutive(ClockKind clock, std::unique_ptr<ContextMaker> contexts, Duration spin,
                       DoorbellWord* doorbell, Pace* pace = nullptr);
  ~CooperativeExecutive() override;

  [[nodiscard]] TimePoint now() const override;
  [[nodiscard]] bool is_virtual() const override { return clock_ == ClockKind::virtual_time; }
  [[nodiscard]] bool tasks_overlap() const override { return false; }
  [[nodiscard]] std::unique_ptr<Event> make_event() override;
  [[nodiscard]] DoorbellWord* doorbell() const override { return doorbell_; }
  [[nodiscard]] std::unique_ptr<Event> make_doorbell_event(DoorbellWord& own) override;
  [[nodiscard]] std::unique_ptr<Task> spawn(TaskOptions options, std::function<void()> body) override;
  void run(std::function<void()> main) override;
  [[nodiscard]] std::vector<std::string> restless_tasks() const override;
  [[nodiscard]] std::optional<StuckTask> stuck_task(Duration limit) override;

  struct Fiber;

  // For CooperativeEvent.
  void block_until(TimePoint deadline);
  void make_ready(Fiber& fiber);
  [[nodiscard]] Fiber* current() { return current_; }
  void post_notification(CooperativeEvent& event);
  void forget_notifications(CooperativeEvent& event);

  // For CooperativeTask.
  void destroy(std::unique_ptr<Fiber> fiber);

 private:
  // Tasks that wait for a time, ordered by time, then priority (larger first), then sequence.
  using TimerKey = std::tuple<TimePoint, int, std::uint64_t, Fiber*>;
  using Timers = std::set<TimerKey>;

  // Tasks that are ready, in the same order. A task never becomes ready with an earlier time than the tasks
  // that are ready already, so it goes to the end. In virtual time all ready tasks have the same time, so it
  // goes before those of lower priority.
  class ReadyQueue {
   public:
    explicit ReadyQueue(bool by_priority) : by_priority_(by_priority) {}
    [[nodiscard]] bool empty() const { return first_ == nullptr; }
    void add(Fiber& fiber);
    Fiber& pop();
    void remove(Fiber& fiber);

   private:
    const bool by_priority_;
    Fiber* first_ = nullptr;
    Fiber* last_ = nullptr;
  };

  [[nodiscard]] bool sleeps_too_long(const Fiber& fiber, Duration limit);
  std::unique_ptr<Fiber> make_fiber(TaskOptions options, std::function<void()> body);
  Fiber& next_to_run();
  void begin(Fiber& fiber);
  void count_turn(Fiber& fiber);
  void set_timer(Fiber& fiber, TimePoint deadline);
  void cancel_timer(Fiber& fiber);
  void take_notifications();
  void notify_rung();
  void fire_timers();
  void wait_for_work();
  void advance_virtual_time();

  const ClockKind clock_;
  const std::unique_ptr<ContextMaker> contexts_;
  DoorbellWord* const doorbell_;
  Pace* const pace_;
  std::atomic<std::int64_t> virtual_now_ns_{0};

  // Touched only by the thread that schedules or holds the baton.
  ReadyQueue ready_;
  Timers timers_;
  std::uint64_t sequence_ = 0;
  Fiber* current_ = nullptr;
  Fiber* main_ = nullptr;
  std::vector<std::string> busy_;        // tasks that have had half of their turns at this instant
  std::vector<CooperativeEvent*> rung_;  // by the doorbell
  bool restless_ = false;                // busy_ keeps time from passing
  bool main_is_next_ = false;            // to hear of it
  bool tells_apart_ = false;             // fibers keep the processor time that they use

  // Filled by other threads.
  FutexEvent inbox_changed_;  // its word is the doorbell, if there is one
  std::mutex inbox_mutex_;
  std::vector<CooperativeEvent*> inbox_;
  std::atomic<bool> inbox_filled_{false};

  // For the monitor. A fiber is destroyed under monitor_mutex_, so that its name can be read.
  std::mutex monitor_mutex_;
  std::atomic<const Fiber*> running_{nullptr};
  std::atomic<std::uint64_t> switches_{0};
  std::uint64_t observed_switches_ = 0;
  Duration cpu_at_observation_{0};
  TimePoint awake_at_{};  // when the running task was last seen not asleep
};

}  // namespace orca::detail
