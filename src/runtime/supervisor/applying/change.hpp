// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "applying/announcing.hpp"
#include "applying/applying.hpp"

namespace orca::supervisor {

/// One graph file, from its reading to its end. The owner knows of it as long as it exists.
///
/// Thread contract: the supervisor's thread; carry_out() waits, so a job of the conductor calls it.
class Applying::Change {
 public:
  Change(Applying& owner, Way way, const Care& care, bool is_edit);
  ~Change();
  Change(const Change&) = delete;
  Change& operator=(const Change&) = delete;

  /// Reads the file, and does all of what it says or nothing.
  Result<Outcome> carry_out(const GraphSource& source);
  /// Notes that a process has ended, or is about to be started.
  void lose(const std::string& process);

 private:
  // A step that takes back what was done. It returns why all goes back, and what could not.
  using Undo = std::function<Error(const Error& reason)>;
  using Connections = std::vector<graph::GraphPlan::Rewiring>;

  Status read(const GraphSource& source);
  [[nodiscard]] Status is_possible() const;
  // The steps, in this order. Each that has done something adds how to take it back.
  Status exchange();
  Status set();
  Status come();
  Status settle();
  Status rewire();
  Status set_late();
  Status exchange_late();
  Status renew();
  // What follows when all has been done, or some of it has not.
  void commit();
  [[nodiscard]] Error go_back(Error reason);

  [[nodiscard]] const graph::ComponentNode& node_of(const std::string& component) const;
  // Returns whether a component's process has ended or was started meanwhile, so that it begins as before.
  [[nodiscard]] bool is_lost(const std::string& component) const;
  [[nodiscard]] Error loss() const;
  // Returns the processes of the components that come and go.
  [[nodiscard]] std::map<std::string, std::string> comers() const;
  [[nodiscard]] bool changes_connections_of(const std::string& component) const;
  // @param changed  the graph with the connections of the component, if they have changed.
  Status exchange(const graph::GraphPlan::Exchange& wanted, const graph::Graph* changed);
  void add_early_undo(Undo undo);
  Status set_all();
  [[nodiscard]] Error exchange_back(const SwapWish& before, const Error& reason);
  // Ends a component.
  void let_go(const std::string& name);
  // Returns why the processes that begin anew cannot now, if that is so.
  [[nodiscard]] Status can_renew() const;
  Status change(const Connections& connections);
  [[nodiscard]] Error change_back(const Connections& connections, const Error& reason);
  // Gives edges of before new memory at both ends if these may not have the same: a process that comes back has made its ends
  // as before with memory of its own, perhaps before the other ends went back; and a client may have left an edge and come
  // back to it, while the server never left it.
  [[nodiscard]] Error renewed(const Error& reason);

  Applying& owner_;
  const Place& place_;
  const Way way_;
  const Care care_;     // of each exchange, there and back
  const bool is_edit_;  // of the run's graph: what operators have set and exchanged stays as it is
  CheckedSystem wanted_;
  graph::GraphPlan plan_;
  bool sets_late_ = false;  // parameters were refused before the connections changed
  std::vector<const graph::GraphPlan::Exchange*> late_exchanges_;  // likewise
  std::size_t set_after_ = 0;   // how many steps came before the parameters
  bool is_renewing_ = false;    // processes end because they are to begin anew
  std::vector<Undo> undo_;      // the last step comes first
  std::set<std::string> lost_;  // processes that have ended since the reading
  std::set<std::string> left_;  // edges that clients have left, see edge_steps()
  Announcing announcing_;
};

}  // namespace orca::supervisor
