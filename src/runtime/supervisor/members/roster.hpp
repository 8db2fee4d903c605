// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "member.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"

namespace orca::supervisor {

/// The processes of a machine: those that its graph has now. Each keeps its place in the run page for the whole run.
///
/// Thread contract: the supervisor's thread.
class Roster {
 public:
  /// @param places  of the run page: the process that has each of them; "": nobody has it yet.
  Roster(const graph::Graph& graph, std::string machine, std::vector<std::string> places);

  /// Returns the processes in the order of graph::processes_on(). The list stays where it is, and those in it do.
  [[nodiscard]] const Members& all() const { return all_; }
  /// Returns the process of that name; null: there is none.
  [[nodiscard]] Member* find(const std::string& name) const;
  /// Returns the process with that place in the run page; null: it has none that the graph has.
  [[nodiscard]] Member* at_place(std::size_t place) const;
  /// Returns which process has which place in the run page.
  [[nodiscard]] const std::vector<std::string>& places() const { return places_; }

  /// Gives all processes of a graph their places.
  /// @errors  failed_precondition: there are not enough.
  Status reserve(const graph::Graph& graph);
  /// Goes on with the processes of another graph.
  /// @pre  reserve(); those that it does not have any more do not run.
  void go_over(const graph::Graph& graph);

 private:
  std::size_t place_for(const std::string& name);

  const std::string machine_;
  std::vector<std::string> places_;
  std::vector<std::unique_ptr<Member>> members_;  // also of earlier graphs, since orders may still name them
  Members all_;
};

}  // namespace orca::supervisor
