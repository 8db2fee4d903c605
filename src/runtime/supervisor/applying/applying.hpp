// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "control/exchanging.hpp"
#include "control/operating.hpp"
#include "members/conductor.hpp"
#include "members/ledger.hpp"
#include "members/member.hpp"
#include "members/reply.hpp"
#include "orca/base/executive.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/graph/plan.hpp"
#include "orca/supervisor/system_facts.hpp"
#include "starting/renewal.hpp"
#include "starting/starter.hpp"

namespace orca::supervisor {

/// Lets a running system become what another graph file says: all of it, or nothing.
///
/// A file is read and checked on a thread of its own. Then code is exchanged, one component after the other, each tried out
/// before; then parameters change, all of them or none; then new components come up, then connections change, all of them or
/// none; then processes begin, end or begin anew; then the new components work. If a step fails, those before it are taken
/// back. At last components that nobody is connected to any more end. A file that asks for more than that is refused before
/// anything changes.
///
/// Thread contract: the supervisor's thread. What answers an operator waits, so a job of the conductor calls it.
class Applying {
 public:
  /// What it needs of the run.
  struct Levers {
    SystemReader read;                ///< Empty: no graph can be read.
    std::optional<Backend> executor;  ///< Of all processes; nothing: each has its own.
    /// Makes a graph that of the run: it is carried out.
    std::function<void(const CheckedSystem&)> accept;
    /// Returns why no processes can begin anew at present, if that is so.
    std::function<Status()> can_renew;
  };
  /// What it works with. All of it outlives the object.
  struct Place {
    Conductor& conductor;
    const graph::Graph& graph;
    const SystemFacts& facts;
    const Members& all;  ///< The processes of the run.
    Operating& operating;
    Exchanging& exchanging;
    Starter& starter;
    Renewal& renewal;
    Ledger& ledger;
  };

  Applying(Place place, Levers levers) : place_(place), levers_(std::move(levers)) {}

  /// Answers with what a file would change, and what that takes.
  void compare(const std::string& file, const ReplyPtr& reply);
  /// Answers with the graph as it runs now, with the values that were set and the types that were exchanged: a file to go back to.
  /// @errors  unimplemented for a system on several machines, which cannot go back.
  void show_present(Reply& reply) const;
  /// Carries a file out. The answer ends when that is done or undone, and has what was changed.
  /// @param words  GRAPH.xml [--tryout DURATION] [--probation DURATION] [--untried]: how carefully code is exchanged.
  void apply(const std::vector<std::string>& words, const ReplyPtr& reply);
  /// Returns why the system can take no other graph now, if that is so.
  /// @errors  unavailable while another one is being compared or applied; unimplemented.
  [[nodiscard]] Status can_change() const;
  // The next three are what an operator asks for with a few words. The words are those of the command.

  /// Makes a connection, or gives it another policy: see with_connection().
  void connect(const std::vector<std::string>& words, const ReplyPtr& reply);
  /// Removes a connection: see without_connection().
  void disconnect(const std::vector<std::string>& words, const ReplyPtr& reply);
  /// Lets a port use another server: see with_other_server().
  void move(const std::vector<std::string>& words, const ReplyPtr& reply);
  /// Carries out the graph's file because it was saved, after what is under way. What comes of it goes to the log.
  void take_saved(const std::string& file) { saved_ = file; }
  /// Notes that a process has ended, or is about to be started. It begins with the graph of before, so what is under way is
  /// taken back.
  void lose(const std::string& process);
  /// Tells processes that work which graph the run has, if it is not that of the start.
  void came_up(const std::vector<Member*>& members) const;
  /// Begins to carry out what was saved. Call it often.
  void go_on();

 private:
  class Change;
  // What was done, or is to be done.
  struct Outcome {
    graph::GraphPlan plan;
    std::vector<Record> processes;  // what becomes of those that do not just go on
  };
  static void answer(const ReplyPtr& reply, const Result<Outcome>& outcome);

  enum class Way { compares, carries_out };
  Result<Outcome> carry_out(const GraphSource& source, Way way, const Care& care = {});
  void carry_out_saved(const std::string& file);
  void edit(const Result<std::string>& text, const ReplyPtr& reply);
  void accept(const CheckedSystem& system, std::string text);
  [[nodiscard]] Status has_one_machine() const;
  [[nodiscard]] graph::Graph present() const;

  const Place place_;
  const Levers levers_;
  std::optional<std::string> saved_;  // a file that waits
  std::optional<std::string>
      applied_;               // the run's graph, as graph::print() writes it; none: that of the start
  Change* change_ = nullptr;  // what is under way
};

}  // namespace orca::supervisor
