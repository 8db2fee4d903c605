// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "control/exchanging.hpp"
#include "members/ledger.hpp"
#include "members/member.hpp"
#include "members/reply.hpp"
#include "orca/graph/graph.hpp"
#include "orca/supervisor/system_facts.hpp"

namespace orca::supervisor {

/// The answers to what an operator asks about a system as a whole.
///
/// Thread contract: the supervisor's thread.
class Showing {
 public:
  /// All of these outlive the object.
  /// @param whole         the graph of the whole system.
  /// @param graph         what of it runs on this machine.
  /// @param edges_in_use  returns the edges in use of those that ports choose from.
  Showing(const graph::Graph& whole, const graph::Graph& graph, const SystemFacts& facts,
          const std::vector<Member*>& members, const Ledger& ledger, const Exchanging& exchanging,
          std::function<std::vector<const graph::Edge*>()> edges_in_use)
      : whole_(whole),
        graph_(graph),
        facts_(facts),
        members_(members),
        ledger_(ledger),
        exchanging_(exchanging),
        edges_in_use_(std::move(edges_in_use)) {}

  /// Learns that there are other machines.
  /// @param machines  answers what is known of all.
  void join(std::function<void(Reply&)> machines) { machines_ = std::move(machines); }

  /// Learns that the system is in a team.
  /// @param team  answers what is known of it.
  void join_team(std::function<void(Reply&)> team) { team_ = std::move(team); }

  /// A line for each system of the team.
  void team(Reply& reply) const;
  /// A line for each machine: how it is, and how its clock differs.
  void machines(Reply& reply) const;
  /// A line for each component: where it runs, how it is, and what it uses up.
  /// @param lines_per_s  that each writes to the log.
  void components(Reply& reply, const std::map<std::string, double>& lines_per_s) const;
  /// The graph of the whole system, as `deployer --print` shows it.
  void graph(Reply& reply) const;
  /// All ports, as `deployer --list-ports` shows them, and which choices are in use.
  void ports(Reply& reply) const;
  /// A line for each plugin, with the types and components that need it.
  void plugins(Reply& reply) const;
  /// A line for each library of object types, with its types.
  static void objects(Reply& reply);
  /// The names of all ports and groups, for completion.
  void names(Reply& reply) const;
  /// What all connections have carried. The processes answer one after the other.
  void counters(const ReplyPtr& reply) const;

 private:
  const graph::Graph& whole_;
  const graph::Graph& graph_;
  const SystemFacts& facts_;
  const std::vector<Member*>& members_;
  const Ledger& ledger_;
  const Exchanging& exchanging_;
  const std::function<std::vector<const graph::Edge*>()> edges_in_use_;
  std::function<void(Reply&)> machines_;  // empty: there is this one only
  std::function<void(Reply&)> team_;      // empty: it is in none
};

}  // namespace orca::supervisor
