// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/executive.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "run/system.hpp"

namespace orca::host {

/// Makes a connection within a process while its components run, in place of the one that its client has, or removes one that
/// is there or not.
///
/// @param system    with both ends.
/// @param deadline  [s of the run's clock] for the client to come to the end of its lap. It may be rewired later all the same.
/// @errors  not_found: there is no such port here; those of LocalLinks::renew(); deadline_exceeded.
/// @thread  that of the system.
Status rewire(System& system, const graph::Edge& edge, bool makes, Event& changed, TimePoint deadline);

/// Lets the client of an edge use it from now on, of those that it chooses from.
/// @errors  not_found: the client is not in this process, or does not choose.
/// @thread  any, once the system is built.
Status move(const System& system, const graph::Edge& edge);

}  // namespace orca::host
