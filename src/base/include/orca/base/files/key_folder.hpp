// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/base/result.hpp"

namespace orca {

/// Returns a name of a graph, machine or process as one part of a path: contexts, which '/' joins, are joined by '-' there, which
/// no name has.
[[nodiscard]] std::string as_file_name(std::string name);

/// Returns the folder of Orca's settings and keys of this user: `$XDG_CONFIG_HOME/orca`, or `~/.config/orca`.
/// @errors  not_found if there is no home.
/// @thread  any that may read the environment.
[[nodiscard]] Result<std::string> config_folder();

/// Returns the folder in which the keys of a secured system are made: keys/SYSTEM in config_folder().
/// @errors  as config_folder().
[[nodiscard]] Result<std::string> keys_of_system(const std::string& system);

/// Returns the name of the folder in it that belongs to a machine.
/// @param machine  empty: the graph declares none.
[[nodiscard]] std::string key_folder_name(const std::string& machine);

/// Returns the folder in which the processes of a machine look for their keys: key_folder_name() in keys_of_system().
/// @errors  as keys_of_system().
[[nodiscard]] Result<std::string> key_folder(const std::string& system, const std::string& machine);

/// Returns the name of the file there with the private key of a process.
[[nodiscard]] std::string key_file_name(const std::string& process);

/// The process that speaks with the other machines, one on each. No process of a graph has such a name.
inline constexpr const char* kPeersKeys = "+peers";

}  // namespace orca
