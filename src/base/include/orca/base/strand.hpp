// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/executive.hpp"

namespace orca {

/// The exception that ends a wait inside a component when its strand must leave its lap: at stop, at suspend,
/// or when the last client has gone. Not a std::exception, so that a component's `catch (const
/// std::exception&)` lets it pass.
struct Interrupted {};

/// The exception of a wait on a thread that runs no component: two threads cannot wait in one component's
/// name.
class ForeignThread : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// A place from which a strand fetches what has arrived for its component, in memory that other processes write.
///
/// Thread contract: any task; it guards itself.
class Intake {
 public:
  virtual ~Intake() = default;
  /// Takes in what has arrived. It does not block.
  /// @return whether something has arrived.
  virtual bool take_in() = 0;
};

/// The one task on which all code of a component runs: laps, handlers, parameter changes and state hooks.
/// They never overlap, so authors need no locks.
///
/// Thread contract: wake() from anywhere; the waits only from the strand's own task.
class Strand {
 public:
  Strand(Executive& executive, TaskOptions options);

  /// Starts the task. `body` must not throw.
  void start(std::function<void()> body);

  /// Reports that something has changed that the strand may be waiting for.
  void wake() {
    if (doorbell_ == nullptr || !is_taking_in_here()) event_->notify();
  }

  /// Sets the condition that makes wait_for() throw Interrupted. The strand evaluates it each time it is
  /// woken. Call before start().
  void set_leave_condition(std::function<bool()> leave) { leave_ = std::move(leave); }

  /// Announces that the strand is to end for good, and others with it. It goes on until its leave condition ends
  /// it, but what others refuse it meanwhile is no news: see RequestClient::receive().
  /// @thread  any.
  void end() { ending_.store(true, std::memory_order_release); }
  [[nodiscard]] bool is_ending() const { return ending_.load(std::memory_order_acquire); }

  /// Sets a function that looks after something while the strand waits. Each wait calls it at its beginning and
  /// again at the time that it returns, which must be in the future; kForever: not again in this wait. It has no
  /// other effect on the wait. Call before start(), or on the strand.
  void set_watch(std::function<TimePoint()> watch) { watch_ = std::move(watch); }

  /// Lets the strand also wait for input. Call before start(), and before anybody wakes the strand.
  /// @return whether its executive can; otherwise watch_input() has no effect.
  /// @errors  throws std::system_error if the system has no more descriptors.
  bool await_input();
  /// Makes each wait end that finds input at a descriptor, as if the strand had been woken: see InputEvent::watch().
  /// @param descriptor  -1: none.
  /// @thread  the strand's.
  void watch_input(int descriptor) {
    if (input_ != nullptr) input_->watch(descriptor);
  }

  /// Lets other processes wake the strand, by ring(*doorbell()).
  /// @param own  the strand's word, unless its executive has one for all strands. It outlives the strand.
  /// @pre  as Executive::make_doorbell_event(). Call before start(), and before anybody wakes the strand.
  void set_doorbell(DoorbellWord& own);
  /// Returns the word by which other processes wake the strand; null: it has none.
  [[nodiscard]] DoorbellWord* doorbell() const { return doorbell_; }

  /// Add and remove a place that the strand looks at before it sleeps, and whenever the component looks at a port.
  /// @thread  the strand's, or any while the component does not run.
  void add_intake(Intake& intake) { intakes_.push_back(&intake); }
  void remove_intake(Intake& intake) { std::erase(intakes_, &intake); }

  /// Takes in what has arrived at all intakes. A wait that does so ends as if the strand had been woken.
  /// @return whether something has arrived. Without intakes it costs one look at an empty list.
  bool take_in() { return !intakes_.empty() && take_in_all(); }

  /// Blocks until `condition` holds or the deadline comes. Serves waits inside a component's own code.
  ///
  /// @return whether the condition holds.
  /// @errors  throws Interrupted; ForeignThread if it would have to wait on a thread that runs no component.
  template <class Condition>
  bool wait_for(TimePoint deadline, Condition&& condition) {
    while (!condition()) {
      if (leave_ && leave_()) throw Interrupted{};
      if (!wait_until(deadline) && executive_.now() >= deadline) return condition();
    }
    return true;
  }

  /// Blocks until woken or until the deadline, without Interrupted. Serves the runtime's own loop.
  void pause_until(TimePoint deadline) { wait_until(deadline); }

  /// Counts an act that cannot be repeated: an object was taken or sent, or time was spent asleep. While the
  /// count stays the same, a waiting lap can be abandoned and started again without loss.
  /// @thread  any.
  void note_activity() {
    activity_.store(activity_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  [[nodiscard]] std::uint64_t activity() const { return activity_.load(std::memory_order_relaxed); }

  /// @return true if the task has ended by the deadline.
  bool join_until(TimePoint deadline) { return task_ == nullptr || task_->join_until(deadline); }

  [[nodiscard]] Executive& executive() const { return executive_; }
  [[nodiscard]] const std::string& name() const { return options_.name; }

 private:
  bool wait_until(TimePoint deadline) {
    if (!executive_.runs_here()) throw_foreign();
    return intakes_.empty() && !watch_ ? event_->wait_until(deadline) : wait_looking(deadline);
  }
  bool wait_looking(TimePoint deadline);
  bool take_in_all();
  bool take_in_awake();
  [[nodiscard]] bool is_taking_in_here() const;
  [[noreturn]] void throw_foreign() const;

  Executive& executive_;
  TaskOptions options_;
  std::unique_ptr<Event> event_;
  InputEvent* input_ = nullptr;  // event_, if it also waits for input
  DoorbellWord* doorbell_ = nullptr;
  std::vector<Intake*> intakes_;
  std::function<bool()> leave_;
  std::function<TimePoint()> watch_;
  std::unique_ptr<Task> task_;
  std::atomic<std::uint64_t> activity_{0};
  std::atomic<bool> ending_{false};
};

}  // namespace orca
