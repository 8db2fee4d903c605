// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/doorbell.hpp"
#include "orca/base/result.hpp"
#include "orca/base/time.hpp"

namespace orca {

class Executive;

namespace detail {

/// The executive whose tasks run on this thread, or null. Declared here only because each push looks at it.
[[gnu::tls_model("initial-exec")]] extern constinit thread_local const Executive* t_executive;

}  // namespace detail

/// A flag that one task waits for. Everything in Orca that blocks is built on it.
///
/// A notification is remembered until it is consumed by a wait; several notifications before that count as
/// one.
///
/// Thread contract: notify() from any task or thread, also from threads that the executive does not know;
/// wait_until() from one task at a time.
class Event {
 public:
  virtual ~Event() = default;
  Event() = default;
  Event(const Event&) = delete;
  Event& operator=(const Event&) = delete;

  virtual void notify() = 0;

  /// Blocks the calling task until notified or until the deadline.
  ///
  /// @return true if notified (the flag is cleared), false at the deadline.
  virtual bool wait_until(TimePoint deadline) = 0;
};

/// An Event that input from outside notifies, too: from a serial line or a socket.
///
/// Thread contract: as Event; watch() as wait_until().
class InputEvent : public Event {
 public:
  /// Lets a wait also end while the descriptor has input to be read, or has failed; a read shows which. Input that is
  /// not read ends every wait at once.
  /// @param descriptor  stays open until another one is watched; -1: none.
  virtual void watch(int descriptor) = 0;
};

struct TaskOptions {
  std::string name;  ///< For people: the component's name.
  int priority = 0;  ///< Fiber and baton: of tasks that are ready at the same time, the larger runs first.
};

/// A function that runs on its own: one strand of execution.
class Task {
 public:
  /// Joins, like std::jthread. The owner has asked the task to end before.
  virtual ~Task() = default;
  Task() = default;
  Task(const Task&) = delete;
  Task& operator=(const Task&) = delete;

  /// Blocks the calling task until this one has ended, or until the deadline.
  ///
  /// @return true if it has ended.
  virtual bool join_until(TimePoint deadline) = 0;
};

/// A task that has run for longer than allowed without waiting on its executive.
struct StuckTask {
  std::string name;
  bool asleep = false;           ///< It does not compute, but waits for something outside the executive.
  bool holds_up_others = false;  ///< No other task can run meanwhile.
};

/// The scheduler of all tasks, by one of three back ends, and the owner of the clock that they see.
///
/// * thread: a thread per task, steady clock.
/// * fiber: all tasks on the thread that called run(), steady or virtual clock.
/// * baton: a thread per task, of which only one runs at a time, scheduled exactly as fibers are; virtual
/// clock.
///
/// With fibers and batons the order is (time at which the task became ready, priority, sequence). Virtual
/// time advances only when no task is ready. The same program therefore gives the same order, whatever the
/// load of the machine.
///
/// Thread contract: now(), runs_here() and Event::notify() from anywhere; the rest from tasks of this
/// executive.
class Executive {
 public:
  virtual ~Executive() = default;
  Executive() = default;
  Executive(const Executive&) = delete;
  Executive& operator=(const Executive&) = delete;

  [[nodiscard]] virtual TimePoint now() const = 0;
  [[nodiscard]] virtual bool is_virtual() const = 0;
  /// Returns whether two tasks can run at the same time. With fibers and batons they cannot: between two
  /// waits, a task alone accesses the data that only tasks touch.
  [[nodiscard]] virtual bool tasks_overlap() const = 0;
  /// Returns whether the calling thread runs a task of this executive. A thread that a component or a library
  /// has started does not.
  /// @thread  any; costs one look at a variable of the thread.
  [[nodiscard]] bool runs_here() const noexcept { return detail::t_executive == this; }
  [[nodiscard]] virtual std::unique_ptr<Event> make_event() = 0;

  /// Makes an event that also waits for input. Null: this executive cannot, because it is virtual or has one thread for all
  /// tasks.
  /// @errors  throws std::system_error if the system has no more descriptors.
  [[nodiscard]] virtual std::unique_ptr<InputEvent> make_input_event() { return nullptr; }

  /// Returns the word by which other processes wake all tasks of this executive; null: it has none.
  [[nodiscard]] virtual DoorbellWord* doorbell() const { return nullptr; }
  /// Makes an event that is also notified when a doorbell is rung: that of the executive if it has one, otherwise
  /// `own`. Rings of the executive's doorbell notify all these events.
  /// @param own  outlives the event; no other event has it.
  /// @pre  threads, or doorbell() is not null.
  [[nodiscard]] virtual std::unique_ptr<Event> make_doorbell_event(DoorbellWord& own) = 0;

  /// Starts a task. `body` must not throw.
  [[nodiscard]] virtual std::unique_ptr<Task> spawn(TaskOptions options, std::function<void()> body) = 0;

  /// Runs `main` as a task and returns when it has ended. All other tasks must have ended by then.
  ///
  /// In virtual time, when no task can ever run again, a wait of `main` ends as if its deadline had come. It also
  /// does once when a task has had kMostTurns turns at one instant: time may then never pass again.
  virtual void run(std::function<void()> main) = 0;

  /// The number of turns that a task may have at one instant of virtual time. A turn ends when the task waits.
  /// A system of the greatest size, 10,000 components, takes far fewer per task.
  static constexpr std::uint32_t kMostTurns = 100'000;

  /// Returns the tasks that keep virtual time from passing: those that had at least half of kMostTurns turns at the
  /// instant at which a task had all of them; empty: time passes.
  [[nodiscard]] virtual std::vector<std::string> restless_tasks() const { return {}; }

  /// Returns a task that has not waited on the executive for too long.
  ///
  /// With fibers and batons it is the task that holds the processor. It counts as stuck after `limit` of its
  /// own CPU time, whatever the load of the machine, or after `limit` of sleep in the system. Waiting for a
  /// reader of its output is no sleep. With threads it can be any task, after `limit` of wall time.
  ///
  /// @thread  a monitoring thread outside the executive, which asks several times a second.
  [[nodiscard]] virtual std::optional<StuckTask> stuck_task(Duration limit) = 0;

  /// Blocks the calling task until the given time.
  void sleep_until(TimePoint time);
};

enum class ClockKind { steady, virtual_time };
enum class Backend { thread, fiber, baton };

struct ExecutiveOptions {
  ClockKind clock = ClockKind::steady;
  Backend backend = Backend::thread;
  /// Longest time that a thread spins before it sleeps [s]; 0: it sleeps at once. The time adapts itself: a
  /// thread spins only where waits tend to end within this time, and never where the process has a single
  /// processor.
  Duration spin{0};
  /// Fiber and baton, steady clock: the word by which other processes wake the tasks; null: they cannot. It
  /// outlives the executive. With threads each strand has its own (Strand::set_doorbell).
  DoorbellWord* doorbell = nullptr;
};

/// @errors  invalid_argument for a combination that cannot work (virtual clock on free-running threads, or with
/// other processes).
[[nodiscard]] Result<std::unique_ptr<Executive>> make_executive(const ExecutiveOptions& options);

}  // namespace orca
