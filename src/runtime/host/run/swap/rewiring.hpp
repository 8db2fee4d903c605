// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <string>

#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/patterns/local/local_links.hpp"
#include "run/system/system.hpp"

namespace orca::host {

/// Returns the error of who asks for a port that is not there.
[[nodiscard]] Error no_such(const graph::PortRef& port);

/// A change of a connection, for System::on_strand().
struct Rewiring {
  std::string component;
  std::function<Status()> body;  ///< May be called as long as both ends are there.
};

/// Returns what makes a connection within a process while its components run, in place of the one that its client has, or
/// removes one that is there or not.
///
/// @param system  with both ends.
/// @param links   that make it.
/// @errors  not_found: there is no such port here; those of LocalLinks::renew(), so that the change itself does not fail.
/// @thread  that of the system.
[[nodiscard]] Result<Rewiring> rewiring_of(const System& system, const graph::Edge& edge, bool makes,
                                           LocalLinks links = {});

/// Lets the client of an edge use it from now on, of those that it chooses from.
/// @errors  not_found: the client is not in this process, or does not choose.
/// @thread  any, once the system is built.
Status move(const System& system, const graph::Edge& edge);

}  // namespace orca::host
