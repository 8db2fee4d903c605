// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "orca/graph/graph.hpp"
#include "orca/idl/machines.hpp"
#include "orca/supervisor/moment.hpp"

namespace orca::supervisor {

/// The systems of a team as one of them knows them: who is there, since when, and what it offers. States and the time go in, news come out.
///
/// Thread contract: one thread.
class TeamDirectory {
 public:
  /// A system that says nothing for this long is gone.
  static constexpr Moment::duration kLossLimit = std::chrono::seconds(1);
  /// Systems that are known at a time; what others say is ignored.
  static constexpr std::size_t kMostMembers = 64;

  /// Another system of the team.
  struct Member {
    std::string name;
    Moment since;     ///< When it was heard first.
    Moment heard_at;  ///< When it was heard last.
    std::vector<idl::TeamOffer> offers;
    std::set<std::string> refused;  ///< Names of those that have another type here.
    bool has_taken_name = false;    ///< Whether yet another system has the same name.
  };

  /// Something for the log.
  struct News {
    bool is_warning = false;
    std::string text;
  };

  /// @param team    of the graph: with what this system offers and hears.
  /// @param system  name of this one.   @param run  number of this run.
  TeamDirectory(const graph::Team& team, std::string system, std::uint64_t run);

  /// Goes on with what ports of another graph offer and hear.
  void go_over(const graph::Team& team);
  /// Returns what this system says to the team. Its creation_time and seq are the caller's.
  [[nodiscard]] idl::TeamState state() const;
  /// Takes what somebody has said, this system too. Anybody on the network can say anything.
  void hear(const idl::TeamState& state, Moment now);
  /// Notices who is silent.
  void look(Moment now);
  /// Returns what has happened since the last call.
  [[nodiscard]] std::vector<News> take_news() { return std::exchange(news_, {}); }

  /// Returns the others, by name.
  [[nodiscard]] std::vector<Member> members() const;

 private:
  using Key = std::pair<std::string, std::uint64_t>;  // name and run

  [[nodiscard]] static bool is_possible(const idl::TeamState& state);
  void enter(const idl::TeamState& state, Moment now);
  void leave(std::map<Key, Member>::iterator member, const std::string& how);
  void compare_names(const Key& key, Moment now);
  void compare_types(Member& member);
  void tell(bool is_warning, std::string text) { news_.push_back({is_warning, std::move(text)}); }

  graph::Team team_;
  const std::string system_;
  const std::uint64_t run_;
  std::map<Key, Member> members_;
  std::set<std::string> taken_;  // names that several systems have, and that are told
  std::vector<News> news_;
};

}  // namespace orca::supervisor
