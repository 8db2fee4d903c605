// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "exit_code.hpp"
#include "orca/base/result.hpp"

namespace orca::orcactl {

/// Makes a folder from a template: each of its files, with @NAME@, @CLASS@, @TYPE@, @ORCA@ and @BIN@ replaced in its name and text.
/// @param templates  the folder with a folder for each kind.
/// @param kind       "component"
/// @param name       of the new folder in the present one: "follow_light".
/// @return the files that were made, without the folder, sorted.
/// @errors invalid_argument for an unknown kind or a name that cannot be one; already_exists if there is something of this name
///         already; not_found without templates; unavailable with the system's reason. Nothing is left behind then.
[[nodiscard]] Result<std::vector<std::string>> make_folder(const std::filesystem::path& templates,
                                                           const std::string& kind, const std::string& name);

/// Carries out new: makes a folder with a component, a driver or an experiment, and prints the commands that build, try and run it.
[[nodiscard]] ExitCode handle_new(const apps::Call& call);

}  // namespace orca::orcactl
