// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include "members/member.hpp"
#include "orca/graph/graph.hpp"
#include "orca/graph/plan.hpp"
#include "orca/supervisor/record.hpp"

namespace orca::supervisor {

/// Returns the components of processes which begin anew that the others do not know yet, or know elsewhere.
[[nodiscard]] std::vector<graph::ComponentNode> newcomers_in(const std::set<std::string>& processes,
                                                             const graph::Graph& running,
                                                             const graph::Graph& wanted);

/// Returns the processes that stay while others begin anew.
[[nodiscard]] Members staying(const Members& all, const std::set<std::string>& renewed);

/// Tells of each process that begins, ends or begins anew what becomes of it, for people.
[[nodiscard]] std::vector<Record> records_of(const std::set<std::string>& renewed, const Members& all,
                                             const graph::Graph& wanted);

}  // namespace orca::supervisor
