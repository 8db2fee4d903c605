// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "command_line.hpp"

namespace orca::apps {

/// Returns the options that a call may have: those of its command, of the program, and --help, --version, --man and
/// --completion.
/// @param command  null: none.
[[nodiscard]] std::vector<OptionSpec> options_of(const Program& program, const Command* command);

/// Returns whether a call asks only for what answer() gives.
[[nodiscard]] bool answers_by_itself(const Call& call);

/// Returns what a call asks for that each program can answer: its help, version, man page, or completion script.
/// @return nothing if it asks for something else.
[[nodiscard]] std::optional<std::string> answer(const Program& program, const Call& call);

/// Returns the text of --help.
[[nodiscard]] std::string help_text(const Program& program);
/// Returns the text of --help for one command.
[[nodiscard]] std::string help_text(const Program& program, const Command& command);
/// Returns the man page in roff.
[[nodiscard]] std::string man_page(const Program& program);

/// Returns the completion script of "bash" or "zsh".
[[nodiscard]] std::string completion_script(const Program& program, const std::string& shell);

}  // namespace orca::apps
