// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "applying/announcing.hpp"
#include "applying/applying.hpp"
#include "applying/system_reading.hpp"

namespace orca::supervisor {

/// One graph file, from its reading to its end.
///
/// Thread contract: the supervisor's thread.
class Applying::Work : public std::enable_shared_from_this<Work> {
 public:
  Work(Applying& owner, GraphSource source, Way way, Told told);
  /// Goes on with what has been read.
  void go_on();
  /// Notes that a process has ended, or is about to be started.
  void lose(const std::string& process);
  [[nodiscard]] bool has_ended() const { return has_ended_; }

 private:
  // What a component ran before.
  struct Before {
    std::string component;
    CodeFacts code;
    graph::Params params;
  };

  [[nodiscard]] const graph::ComponentNode& node_of(const std::string& component) const;
  // Returns whether a component's process has ended or was started meanwhile, so that it begins as before.
  [[nodiscard]] bool is_lost(const std::string& component) const;
  [[nodiscard]] Error loss() const;
  void exchange_next();
  void exchanged(const Result<Record>& outcome);
  void set_all();
  void set_back(const Error& reason);
  // Constructs new components beside those that are there, and those that will go.
  void come();
  // Returns the processes of the components that come and go.
  [[nodiscard]] std::map<std::string, std::string> comers() const;
  // Lets the new components go again.
  void leave(const Error& reason);
  // Ends components, the last first, and goes on when that is done.
  void let_go(std::vector<std::string> names, std::function<void()> done);
  // Connects the new components with what they use, then configures them: they find their connections, as at a start.
  void settle();
  void configure(std::size_t next);
  // Lets the others change their connections, to the new components as well.
  void rewire();
  // Returns why the processes that begin anew cannot now, if that is so.
  [[nodiscard]] Status can_renew() const;
  // All else is as wanted. Now processes begin, end or begin anew, with the new graph.
  void renew();
  // The processes that should begin anew run as before. The others go back, too.
  void run_as_before(const Error& reason);
  // The run has the new graph. Nobody is connected to what it does not have any more.
  void commit();
  // Removes the connections of the new components again.
  void part(const Error& reason);
  void undo(const std::vector<graph::GraphPlan::Rewiring>& connections, const Error& reason,
            void (Work::*then)(const Error&));
  // Gives edges of before new memory at both ends if these may not have the same: a process that comes back has made its ends
  // as before with memory of its own, perhaps before the other ends went back; and a client may have left an edge and come
  // back to it, while the server never left it.
  Error renewed(const Error& reason);
  void change(const std::vector<graph::GraphPlan::Rewiring>& connections,
              std::function<void(const Status&)> done);
  // Lets nobody wait for what is sent or asked on a new connection until the process at its other end has begun anew.
  void cut_off_after(JointStep& step);
  void carry_out(std::vector<JointStep> steps, std::function<void(const Status&)> done);
  // Exchanges back what was exchanged, the last first.
  void go_back(const Error& reason);
  void end(const std::optional<Error>& error);

  Applying& owner_;
  const Way way_;
  const bool is_edit_;  // of the run's graph: what operators have set and exchanged stays as it is
  const Told told_;
  CheckedSystem wanted_;
  graph::GraphPlan plan_;
  std::vector<Record> processes_;                         // see Outcome
  bool is_renewing_ = false;                              // processes end because they are to begin anew
  std::vector<Before> before_;                            // of each exchange that was begun
  std::map<std::string, graph::Params> settings_before_;  // by component
  std::set<std::string> lost_;                            // processes that have ended since the reading
  const std::shared_ptr<std::set<std::string>> left_ =
      std::make_shared<std::set<std::string>>();  // edges that clients have left, see edge_steps()
  Announcing announcing_;
  bool has_ended_ = false;
  std::optional<SystemReading> reading_;
};

}  // namespace orca::supervisor
