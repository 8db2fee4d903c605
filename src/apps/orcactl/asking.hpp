// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <set>
#include <string>

#include "client.hpp"
#include "common/command_line.hpp"
#include "exit_code.hpp"

namespace orca::orcactl {

/// Carries out a command that the supervisor answers, once, or again and again with --watch.
[[nodiscard]] ExitCode ask(const apps::Call& call);

/// Prints names for completion, one per line. Without a system there are none.
[[nodiscard]] ExitCode print_names(const apps::Call& call);

/// Returns the values of the cells of a name in the answer to a command; none if it fails.
[[nodiscard]] std::set<std::string> names_of(Client& client, const char* command, const char* cell);

/// Returns the components that have a port of that name, which begins with a dot.
[[nodiscard]] std::vector<std::string> components_with(Client& client, std::string_view port);

/// Prints a failure to stderr.
/// @return its exit status.
ExitCode report(const Failure& failure);

}  // namespace orca::orcactl
