// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "exit_code.hpp"
#include "orca/base/result.hpp"

namespace orca::orcactl {

/// Returns the goals that the words after "go" name, as Command takes them: each word is a place, but two numbers in a row are
/// coordinates [m], also with their unit in the word or behind it: "3.2 4", "3.2m 4m", "3.2 m 4 m".
/// @errors  invalid_argument: a number is alone.
[[nodiscard]] Result<std::vector<std::string>> goals_in(const std::vector<std::string>& words);

/// Carries out go: sends a robot somewhere, or shows where it goes.
[[nodiscard]] ExitCode handle_go(const apps::Call& call);

}  // namespace orca::orcactl
