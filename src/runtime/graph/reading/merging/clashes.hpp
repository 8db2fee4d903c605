// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "reading/node.hpp"
#include "reading/report.hpp"

namespace orca::graph {

// The names and connections that a graph has twice. They are collected before they are reported, so that an
// <include> or <use> that repeats existing parts gives one line, however many it repeats.
class Clashes {
 public:
  // @param node  the later one of the two; both must outlive this object
  void add(const Node& node, const Node& first);
  void report(Report& report) const;

 private:
  struct Clash {
    const Node* node;
    const Node* first;
  };
  // The ways by which both came into the graph, from where they part; null: the part is in the file where
  // they part.
  using Cause = std::pair<const Origin*, const Origin*>;

  static Cause cause_of(const Node& node, const Node& first);
  static void report_one(const Clash& clash, Report& report);
  static void report_group(const Cause& cause, const std::vector<Clash>& group, Report& report);
  static void report_bringer(const Cause& cause, const std::vector<Clash>& group, Report& report);

  std::map<Cause, std::size_t> index_;
  std::vector<std::pair<Cause, std::vector<Clash>>> groups_;  // in the order of the file
};

}  // namespace orca::graph
