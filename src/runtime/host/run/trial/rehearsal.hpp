// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

#include "orca/host/catalogue.hpp"

namespace orca::host {

/// Calls configure() of components in a copy of this process: their code is loaded, the ports are connected and all
/// hardware is closed. No other hook is called. A component that ends the copy, or does not return, is reported too,
/// and the others are tried again without it. Of components that differ only in their names and in who is at the other ends
/// of their connections, 50 are tried. The trial of a component ends where it would leave a trace outside the
/// copy; what comes after that is left to the start of the system.
///
/// A component that is like one that stood its trial before is not tried again.
///
/// Under ThreadSanitizer, which can follow neither fibers nor the threads of a copied process, nothing is tried.
///
/// @param clock  clock of the run that the graph is checked for.
/// @param give_up  asked several times a second; true ends the trials. Empty: never.
/// @param stood  also receives those that stand it now.
/// @return their faults, in the order of the candidates.
/// @thread  the one that uses the catalogue.
[[nodiscard]] std::vector<graph::ComponentFault> rehearse(const graph::Graph& graph,
                                                          const graph::Candidates& candidates,
                                                          PluginCatalogue& catalogue, ClockKind clock,
                                                          const std::function<bool()>& give_up,
                                                          TrialsStood& stood);

}  // namespace orca::host
