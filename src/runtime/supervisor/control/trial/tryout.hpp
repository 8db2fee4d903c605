// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "control/trial/questioner.hpp"
#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"
#include "orca/host/shadow.hpp"
#include "orca/plugin/image.hpp"

namespace orca::supervisor {

/// A line from the host process of a component, which tells what reaches a port of it.
struct WatchedPort {
  std::string port;  ///< Its name in the graph.
  Descriptor line;   ///< As an operator's line: see orca/supervisor/control.hpp.
};

/// What leads from a trial to the system's processes.
struct TryoutLines {
  std::vector<WatchedPort> ports;   ///< Of the component: all that it is to be tried with.
  std::vector<ServerLine> servers;  ///< Of the component: those that can be asked.
};

/// Tries new code for a component before it is exchanged: for a while it watches what reaches the component, then it lets the
/// new code work on that in a copy of the supervisor's process (host::run_in_shadow()). The component's own process only hands
/// out what it would show to an operator as well, and the servers that the new code asks answer as they would answer an
/// operator.
/// @param give_up  asked several times a second; true ends the trial.
/// @thread  any; it takes as long as the order says, and longer.
Result<host::ShadowReport> try_out(host::ShadowOrder order, plugin::PluginImage& plugin, TryoutLines lines,
                                   const std::function<bool()>& give_up);

}  // namespace orca::supervisor
