// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace orca::orcactl {

/// What a word on the command line names, for completion.
enum class Names { none, component, group, port, param, process, system, file };

/// A word after a command.
struct Argument {
  std::string_view name;  ///< In capitals: "PORT".
  Names names = Names::none;
  bool optional = false;
  bool repeats = false;  ///< The last of a command: any number of them.
};

/// An option of a command.
struct OptionSpec {
  std::string_view name;   ///< "--follow"
  std::string_view value;  ///< Name of its value, "N"; empty: it has none.
  std::string_view text;   ///< For people.
  bool repeats = false;    ///< Each of them counts, not only the last one.
};

/// How a command is carried out.
enum class Way {
  ask,         ///< The supervisor answers.
  tap,         ///< Objects that pass a port.
  offer,       ///< An object for a port.
  names,       ///< Names for completion.
  completion,  ///< A script for a shell.
  manual,      ///< The man page.
};

/// A command of orcactl. The parser, --help, completion and the man page are all made from the table of commands.
struct Command {
  std::string_view name;
  Way way = Way::ask;
  std::vector<Argument> arguments{};
  std::vector<OptionSpec> options{};  ///< Beyond those that all commands have.
  bool pairs = false;                 ///< Whether the words come in pairs.
  bool watches = false;               ///< Whether --watch makes sense.
  bool tells = false;                 ///< Whether it answers with records.
  std::string_view text;              ///< One line for people.
  std::string_view details{};         ///< More, for the man page.
};

/// Returns all commands.
[[nodiscard]] std::span<const Command> commands();
/// Returns a command; null if there is none of that name.
[[nodiscard]] const Command* find_command(std::string_view name);
/// Returns the options that all commands have.
[[nodiscard]] std::span<const OptionSpec> common_options();

}  // namespace orca::orcactl
