// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>

#include "commands.hpp"

namespace orca::orcactl {

/// Returns the text of --help.
[[nodiscard]] std::string help_text();
/// Returns the text of --help for one command.
[[nodiscard]] std::string help_text(const Command& command);
/// Returns the man page in roff.
/// @param version  of Orca.
[[nodiscard]] std::string man_page(const std::string& version);

/// Returns the completion script of a shell; empty if it is neither "bash" nor "zsh".
[[nodiscard]] std::string completion_script(const std::string& shell);

}  // namespace orca::orcactl
