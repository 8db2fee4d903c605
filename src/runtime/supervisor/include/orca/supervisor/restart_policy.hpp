// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/graph/process.hpp"
#include "orca/supervisor/moment.hpp"

namespace orca::supervisor {

/// What to do after a process has ended. What is to be started is asked for with RestartPolicy::take_due().
struct RestartDecision {
  bool restarts = false;         ///< The process is started again.
  bool gives_up = false;         ///< There were too many restarts: everything is to be taken down.
  std::vector<std::size_t> end;  ///< Processes to be ended now, the last in the order of the graph first.
};

/// Decides which processes are ended and started again after one of them has ended, and when. It does neither itself, and
/// has no clock.
///
/// * A process is started again by its own rule: permanent, transient or temporary. One that is not started again
///   concerns no other process.
/// * The strategy says which others are ended and started again with it. Of these, a temporary process is ended and stays
///   so; one that is not running because it has finished stays so, too.
/// * The first restart of a process follows at once. After that each waits: 50 ms, then twice as long each time, up to
///   2 s. A process that has had no fault for `within` begins anew.
/// * A process that is started on demand is asleep at first, and again after each end: it is started when it is needed. What
///   is said above of restarts then says when it may be at the earliest.
/// * More than `restarts` restarts within `within`, of all processes together, are too many. Processes that are started
///   again only because of another one do not count, nor do those after a fault that another program has caused.
///
/// Thread contract: not synchronised.
class RestartPolicy {
 public:
  /// Returns whether a process is needed.
  using IsNeeded = std::function<bool(std::size_t process)>;

  /// All processes run at first, or are about to, unless they are started on demand.
  /// @param processes  in the order of the graph, which gives them their indices.
  RestartPolicy(const std::vector<graph::ProcessNode>& processes, const graph::Supervision& rules);

  /// Reports that a process has ended, also one that was to be ended by a decision, and one that could not be started.
  /// @param is_normal  it ended by itself, with exit status 0.
  /// @param now        not before the times of earlier calls.
  /// @param counts     whether its restart is one of those that can be too many. It waits like others.
  [[nodiscard]] RestartDecision ended(std::size_t process, bool is_normal, Moment now, bool counts = true);

  /// Returns whether a process has ended and is not to be started again.
  [[nodiscard]] bool has_finished(std::size_t process) const {
    return processes_[process].state == State::finished;
  }

  /// Notes that a process on demand is about to be ended, because nobody needs it: that is no fault.
  void put_to_sleep(std::size_t process);
  /// Returns whether a process is ended because nobody needs it.
  [[nodiscard]] bool is_dozing(std::size_t process) const {
    return processes_[process].state == State::dozing;
  }
  /// Returns whether a process does not run and is to be started when it is needed.
  [[nodiscard]] bool is_asleep(std::size_t process) const {
    return processes_[process].state == State::asleep;
  }

  /// Lets a process start again as soon as it has ended, whatever its rule, because somebody wants it so. It counts as no
  /// fault and concerns no other process. Whoever calls this ends it, if it runs. One on demand is still to be needed.
  void restart(std::size_t process, Moment now);

  /// Notes that a process is about to be ended, and stays away unless restart() is called: that is no fault. Until it has
  /// ended, none is started.
  void retire(std::size_t process);
  /// Goes on with other processes: those of the same name are as they were, the others have finished.
  void go_over(const std::vector<graph::ProcessNode>& processes);

  /// Returns the processes that are to be started now, in the order of the graph, once each. From here on they count as
  /// running. None is returned while one that is to be ended for a restart still runs.
  /// @param is_needed  asked of those that are asleep; empty: none is.
  [[nodiscard]] std::vector<std::size_t> take_due(Moment now, const IsNeeded& is_needed = {});
  /// Returns when take_due() will next have something, whatever is needed; nothing if never, or if an end is awaited
  /// first.
  [[nodiscard]] std::optional<Moment> due() const;

 private:
  enum class State {
    running,
    ending,    // to be ended, then started again
    leaving,   // to be ended, and not started again
    waiting,   // to be started at start_at
    dozing,    // to be ended, then asleep
    asleep,    // to be started when it is needed, not before start_at
    finished,  // not to be started again
  };
  struct Process {
    std::string name;
    graph::Restart rule = graph::Restart::permanent;
    bool on_demand = false;
    State state = State::running;
    Moment start_at{};       // while ending, waiting or asleep
    std::size_t faults = 0;  // since it last had none for `within`
    Moment last_fault{};
  };

  [[nodiscard]] bool is_restarted(const Process& process, bool is_normal) const;
  [[nodiscard]] static State to_start_again(const Process& process) {
    return process.on_demand ? State::asleep : State::waiting;
  }
  [[nodiscard]] bool are_too_many(Moment now);
  Duration delay_after_fault(Process& process, Moment now) const;
  [[nodiscard]] std::size_t first_concerned(std::size_t process) const;
  [[nodiscard]] std::size_t end_of_concerned(std::size_t process) const;
  RestartDecision restart_from(std::size_t process, Moment start_at);
  RestartDecision give_up();
  [[nodiscard]] bool awaits_end() const;

  const graph::Supervision rules_;
  std::vector<Process> processes_;
  std::deque<Moment> restarts_;  // of the last `within`, oldest first
};

}  // namespace orca::supervisor
