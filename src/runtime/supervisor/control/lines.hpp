// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "control/system_names.hpp"
#include "members/conductor.hpp"
#include "members/reply.hpp"
#include "orca/base/time.hpp"
#include "orca/host/component_report.hpp"

namespace orca::supervisor {

/// Joins a client to the host processes of the ports that it names; the supervisor itself keeps no end. Ports of a process
/// that does not have them at present are left out, unless only one is named; so are ports that there are not, each with a record
/// of its own: "port", and "missing", the reason.
/// @param words  PORT... [--tap] [--objects] [--bound BYTES]: with the objects that pass, or their times only; what may wait
///               for the client in each process.
/// If one port is named to be looked at, and its component does no laps at present, a note says so.
/// @return whether there are lines now with a bound of their own.
/// @thread  the supervisor's thread, on a fiber that may wait.
bool open_lines(const std::vector<std::string>& words, const SystemNames& names, const host::Reports& reports,
                Conductor& conductor, Reply& reply);

/// Lists the ports of this machine through which objects leave their component, for a recorder. The first record has the start
/// of the run [ns of its clock], from which on the log counts.
void list_sources(const SystemNames& names, TimePoint start, Reply& reply);

}  // namespace orca::supervisor
