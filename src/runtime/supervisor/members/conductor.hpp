// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "members/member.hpp"
#include "orca/base/executive.hpp"
#include "orca/supervisor/moment.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// The jobs of a supervisor that take time. Each is a task of its own: a straight function that waits for what others do.
/// One of them runs at a time, and the supervisor's loop rests meanwhile, so they need no locks. What ends a wait early is
/// its value: a process that has ended gives no answer.
///
/// Thread contract: the supervisor's thread, inside run().
class Conductor {
 public:
  /// @param wake  lets the supervisor's loop call go_on() soon. It is called on other threads.
  explicit Conductor(std::function<void()> wake);
  ~Conductor();
  Conductor(const Conductor&) = delete;
  Conductor& operator=(const Conductor&) = delete;

  /// Runs the supervisor's loop, and then ends all jobs: see close().
  /// @errors  throws what the loop throws.
  void run(const std::function<void()>& loop);
  /// Begins a job. It runs at once, until it waits for the first time. A job may begin others.
  /// @errors  throws what the job throws, as go_on() does.
  void begin(const std::string& name, std::function<void()> job);
  /// Lets all jobs go on that need not wait any more. The loop calls it again and again.
  void go_on(Moment now);
  /// Ends all waits, present and later ones, so that all jobs come to their end.
  void close();

  /// Blocks the calling job until something is so, which is looked at in each go_on().
  /// @return false: it was not so at the deadline, or all jobs are to end.
  bool wait(const std::function<bool()>& is_so, Moment deadline = Moment::max());
  /// Sends an order to a process, and blocks the calling job until the answer is there.
  /// @return nothing: the process has ended without an answer.
  std::optional<Answer> ask(Member& member, Order order);
  /// Runs something that takes long on a thread of its own, and blocks the calling job until it has returned. Meanwhile it
  /// may use what the supervisor's thread does not.
  /// @param work  gets a function that returns true when it had better give up: all jobs are to end. What it throws is thrown
  ///              here.
  void run_aside(const char* name, const std::function<void(const std::function<bool()>& give_up)>& work);

 private:
  struct Job;
  void resume(Job& job);
  void reap();

  const std::function<void()> wake_;
  const std::unique_ptr<Executive> executive_;
  const std::unique_ptr<Event> loop_turn_;
  std::vector<std::unique_ptr<Job>> jobs_;
  Job* current_ = nullptr;  // null: the loop
  bool is_closed_ = false;
};

/// The answer of a process to one order, for those who wait for several at a time.
class PendingAnswer {
 public:
  /// Sends the order.
  PendingAnswer(Member& member, Order order);
  PendingAnswer(PendingAnswer&&) = default;
  PendingAnswer& operator=(PendingAnswer&&) = default;
  /// Returns whether the answer is there, or will never be, because the process has ended.
  [[nodiscard]] bool is_over() const { return answer_->has_value() || answer_.use_count() == 1; }
  /// Returns the answer. Nothing: there is none.
  [[nodiscard]] const std::optional<Answer>& answer() const { return *answer_; }

 private:
  std::shared_ptr<std::optional<Answer>> answer_;  // shared with the member until it is over
};

}  // namespace orca::supervisor
