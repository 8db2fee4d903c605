// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "task.hpp"

namespace orca::tasks {

/// The end of something that takes time.
struct Ending {
  bool done = false;
  std::string reason;  ///< Why it has failed, for people: "blocked: ...".
};

/// Who sets parameters of components for a task, and suspends components.
class Setter {
 public:
  /// Orders what a step With or Suspend says. @return the number of the order, not 0.
  virtual std::uint64_t order(const Step& step) = 0;
  /// Returns how such an order has ended, if it has; done with what was so before as its reason.
  virtual std::optional<Ending> outcome(std::uint64_t number) = 0;
  /// Makes it as it was before.
  /// @param number  of the order that must end before; 0: none.
  /// @param before  what was so; empty: the outcome of that order.
  virtual void set_back(const Step& step, std::uint64_t number, const std::string& before) = 0;

 protected:
  ~Setter() = default;
};

/// The hands and ears of a task.
class Actor {
 public:
  using Ending = tasks::Ending;

  /// Begins to drive or to ask.
  virtual std::optional<Ending> begin(const Step& step) = 0;
  /// Returns how it has ended, if it has.
  virtual std::optional<Ending> go_on(const Step& step) = 0;
  /// Gives up what has begun and has not ended.
  virtual void halt(const Step& step) = 0;
  /// Returns who carries out the steps With and Suspend.
  [[nodiscard]] virtual Setter& setter() = 0;
  virtual void say(const std::string& text) = 0;
  [[nodiscard]] virtual bool holds(const Condition& condition) = 0;

 protected:
  ~Actor() = default;
};

/// A task that runs. It is advanced in ticks, and remembers in plain values where it is, so that it can go on in another object.
///
/// A tick looks at the watching handlers (On) from the outside to the inside before anything goes on. A failure climbs to the
/// nearest Try that catches it.
///
/// Thread contract: not synchronised.
class TaskRun {
 public:
  enum class State : std::uint8_t { idle, running, done, failed };

  /// All that is remembered of a step.
  struct Memory {
    State state = State::idle;
    std::uint32_t at = 0;     ///< Which of its children is on.
    std::uint32_t count = 0;  ///< Rounds, attempts, or how often it has caught.
    std::uint64_t order = 0;  ///< With, suspend: number of the order that is under way; 0: none.
    double since = 0.0;       ///< [s] When it began.
    bool known = false;       ///< On: its condition was seen, and has held since. With, suspend: it is so.
    std::string reason{};     ///< Why it has failed.
    std::string before{};     ///< With, suspend: what was so before.
  };

  /// @param task  outlives this object.
  explicit TaskRun(const Task& task) : task_(task), memory_(task.steps.size()) {}

  /// Goes on with the task.
  /// @param time [s]  of a clock that only advances.
  /// @pre  state() is idle or running.
  void tick(Actor& actor, double time);
  /// Gives up what is on the way; the next tick begins it again.
  void halt(Actor& actor);
  /// Takes the step that is on the way for done.
  /// @return the step; nothing if none is.
  std::optional<std::size_t> skip(Actor& actor);
  /// Takes note that nothing could go on for some time [s]: it counts for no step.
  void delay(double time);
  /// Ends the task with a failure.
  void end(Actor& actor, const std::string& reason);

  [[nodiscard]] State state() const { return memory_[0].state; }
  /// Returns why the last step failed, whether or not that was handled; empty: none has.
  [[nodiscard]] const std::string& last_failure() const { return last_failure_; }
  /// Returns the steps that are on the way, e.g. that the robot drives.
  [[nodiscard]] std::vector<std::size_t> active() const;

  /// Returns all that is remembered of the steps, in the order of the task.
  [[nodiscard]] const std::vector<Memory>& memories() const { return memory_; }
  /// Goes on where another object was; what was on the way begins again.
  /// @pre  memories are of a task with as many steps
  void go_on_from(std::vector<Memory> memories, std::string last_failure);

 private:
  State run(std::size_t step);
  State run_wrapped(std::size_t step);
  State run_sequence(std::size_t step);
  State run_fallback(std::size_t step);
  State run_parallel(std::size_t step);
  State run_repeat(std::size_t step);
  State run_retry(std::size_t step);
  State run_timeout(std::size_t step);
  State run_with(std::size_t step);
  State run_attempt(std::size_t step);
  State run_leaf(std::size_t step);
  State run_action(std::size_t step);

  std::size_t watch(std::size_t attempt);
  State run_handler(std::size_t attempt);
  State handled(std::size_t attempt, std::size_t handler);

  State fail(std::size_t step, std::string reason);
  void pause(std::size_t step);
  void set_back(std::size_t step);

  [[nodiscard]] const Step& step_of(std::size_t step) const { return task_.steps[step]; }

  const Task& task_;
  std::vector<Memory> memory_;
  std::string last_failure_;
  Actor* actor_ = nullptr;  // of the tick
  double time_ = 0.0;       // [s] of the tick
};

}  // namespace orca::tasks
