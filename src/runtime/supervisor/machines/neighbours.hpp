// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "machines/clocks.hpp"
#include "machines/gathering.hpp"
#include "machines/messenger.hpp"
#include "machines/motors_accord.hpp"
#include "members/ledger.hpp"
#include "members/reply.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/run_result.hpp"
#include "orca/supervisor/run_page.hpp"

namespace orca::supervisor {

/// The supervisors of the other machines of a system, as far as the run on this machine depends on them.
///
/// Thread contract: the supervisor's thread.
class Neighbours {
 public:
  /// @param graph   with at least two machines; outlives the object, as the ledger does.
  /// @param here    name of this machine in the graph.
  /// @param start   of a host process.
  /// @param ledger  takes the alarms.
  /// @param page    gets the corrections of the other machines' clocks; outlives the object.
  Neighbours(const graph::Graph& graph, const std::string& here, HostStart start, Ledger& ledger,
             const RunPage& page);

  /// Hears the others, notices their loss, and tells them what has changed here.
  void turn(Moment now);

  /// Returns whether all machines are there, or have been once.
  [[nodiscard]] bool have_gathered();
  /// Returns whom the start waits for, for people: "machine brain".
  [[nodiscard]] std::string awaited() const;

  /// Returns the outcome and the reason if the run is to end because of another machine.
  [[nodiscard]] std::optional<Gathering::Verdict> verdict() const { return gathering_.verdict(); }

  /// Tells the others how the run has ended here.
  void conclude(host::RunOutcome outcome, const std::string& why, Moment now);
  /// Takes leave of the others once they know that the run has ended. Call it until it returns true: nothing is left.
  [[nodiscard]] bool take_leave(Moment now);

  [[nodiscard]] Gathering& gathering() { return gathering_; }
  /// Returns what all machines know of the system's emergency stop.
  [[nodiscard]] MotorsAccord& motors() { return motors_; }
  /// A line for each machine, this one first: how it is, and how its clock differs.
  void show(Reply& reply) const;
  /// Returns the process that speaks with the others, to be polled.
  [[nodiscard]] Member& member() { return messenger_.member(); }

 private:
  void tell_news();
  void tell_clocks(TimePoint now);
  void hear(const idl::MachineState& state);
  [[nodiscard]] bool listens(Moment now) const;
  void publish(Moment now);

  const std::string here_;
  const std::uint64_t run_;
  std::map<std::string, std::size_t> places_;  // of machines in the graph
  Gathering gathering_;
  Clocks clocks_;
  MotorsAccord motors_;
  Messenger messenger_;
  Ledger& ledger_;
  const RunPage& page_;
  bool has_gathered_ = false;
  std::string told_;  // whom the start waits for
  idl::MachineState said_;
  std::uint64_t seq_ = 0;
  Moment say_at_{};  // when to repeat
  Moment concluded_at_{};
  bool leaves_ = false;
};

/// Returns the outcome of the run on this machine if it ends because of another one.
[[nodiscard]] host::RunOutcome outcome_of(idl::MachineEnd end);

}  // namespace orca::supervisor
