// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "manual.hpp"

#include <algorithm>

namespace orca::orcactl {
namespace {

constexpr std::size_t kColumn = 34;  // of the second column of --help

constexpr const char* kExits[] = {"0 done", "1 refused: the reason is on stderr",
                                  "2 the command line is wrong", "3 no deployer runs"};

std::string usage_of(const Command& command) {
  std::string usage(command.name);
  for (const Argument& argument : command.arguments) {
    const std::string name = std::string(argument.name) + (argument.repeats ? "..." : "");
    usage += " " + (argument.optional ? "[" + name + "]" : name);
  }
  return usage;
}

std::string usage_of(const OptionSpec& option) {
  return std::string(option.name) + (option.value.empty() ? "" : " " + std::string(option.value));
}

std::string line_of(const std::string& what, std::string_view text) {
  const std::string left = "  " + what;
  const std::string blanks(left.size() + 2 < kColumn ? kColumn - left.size() : 2, ' ');
  return left + blanks + std::string(text) + "\n";
}

// Returns a text with what roff would obey made harmless.
std::string roff(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\\') safe += '\\';
    safe += c == '-' ? std::string("\\-") : std::string(1, c);
  }
  return safe.starts_with('.') || safe.starts_with('\'') ? "\\&" + safe : safe;
}

std::string roff_item(const std::string& what, std::string_view text) {
  return ".TP\n.B " + roff(what) + "\n" + roff(text) + "\n";
}

std::string roff_command(const Command& command) {
  std::string page = roff_item(usage_of(command), command.text);
  if (!command.details.empty()) page += ".IP\n" + roff(command.details) + "\n";
  for (const OptionSpec& option : command.options)
    page += ".IP\n" + roff(usage_of(option) + ": " + std::string(option.text)) + "\n";
  return page;
}

// Returns the options of a command, with those that all have.
std::string options_of(const Command& command) {
  std::string words;
  for (const OptionSpec& option : common_options())
    if (option.name != "--watch" || command.watches)
      words += (words.empty() ? "" : " ") + std::string(option.name);
  for (const OptionSpec& option : command.options) words += " " + std::string(option.name);
  return words;
}

const char* kind_of(const Command& command) {
  if (command.name == "names") return "kind";
  if (command.name == "completion") return "shell";
  switch (command.arguments.empty() ? Names::none : command.arguments.front().names) {
    case Names::component: return "component";
    case Names::group: return "group";
    case Names::port: return "port";
    case Names::param: return "param";
    case Names::process: return "process";
    case Names::system: return "system";
    case Names::file:
    case Names::none: break;
  }
  return "";
}

std::string command_names() {
  std::string names;
  for (const Command& command : commands()) names += (names.empty() ? "" : " ") + std::string(command.name);
  return names;
}

// The same function in both shells, with the options and the kind of name of each command.
std::string command_cases() {
  std::string cases;
  for (const Command& command : commands())
    cases += "    " + std::string(command.name) + ") options=\"" + options_of(command) + "\"; kind=\"" +
             kind_of(command) + "\" ;;\n";
  return cases;
}

std::string bash_script() {
  return R"sh(# bash completion of orcactl, made by: orcactl completion bash
_orcactl() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command= system= options kind i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case ${COMP_WORDS[i]} in
    --system) system=${COMP_WORDS[++i]} ;;
    -*) ;;
    *) command=${COMP_WORDS[i]}; break ;;
    esac
  done
  COMPREPLY=()
  if [[ $before == --system ]]; then
    COMPREPLY=($(compgen -W "$(orcactl names system 2>/dev/null)" -- "$word"))
    return
  fi
  if [[ -z $command ]]; then
    COMPREPLY=($(compgen -W ")sh" +
         command_names() + R"sh( --system --json --help" -- "$word"))
    return
  fi
  case $command in
)sh" + command_cases() +
         R"sh(  esac
  if [[ $word == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$word"))
    return
  fi
  case $kind in
  "") ;;
  kind) COMPREPLY=($(compgen -W "component group port param process system" -- "$word")) ;;
  shell) COMPREPLY=($(compgen -W "bash zsh" -- "$word")) ;;
  *) COMPREPLY=($(compgen -W "$(orcactl ${system:+--system "$system"} names $kind 2>/dev/null)" -- "$word")) ;;
  esac
}
complete -F _orcactl orcactl
)sh";
}

std::string zsh_commands() {
  std::string lines;
  for (const Command& command : commands()) {
    std::string text(command.text);
    std::erase(text, '\'');
    lines += "    '" + std::string(command.name) + ":" + text + "'\n";
  }
  return lines;
}

std::string zsh_script() {
  return R"sh(#compdef orcactl
# zsh completion of orcactl, made by: orcactl completion zsh
_orcactl() {
  local command= system= options kind i
  local -a commands=(
)sh" + zsh_commands() +
         R"sh(  )
  for ((i = 2; i < CURRENT; ++i)); do
    case ${words[i]} in
    --system) ((++i)); system=${words[i]} ;;
    -*) ;;
    *) command=${words[i]}; break ;;
    esac
  done
  if [[ ${words[CURRENT-1]} == --system ]]; then
    compadd -- ${(f)"$(orcactl names system 2>/dev/null)"}
    return
  fi
  if [[ -z $command ]]; then
    _describe command commands
    compadd -- --system --json --help
    return
  fi
  case $command in
)sh" + command_cases() +
         R"sh(  esac
  if [[ ${words[CURRENT]} == -* ]]; then
    compadd -- ${=options}
    return
  fi
  case $kind in
  "") ;;
  kind) compadd -- component group port param process system ;;
  shell) compadd -- bash zsh ;;
  *) compadd -- ${(f)"$(orcactl ${system:+--system} ${system:+"$system"} names $kind 2>/dev/null)"} ;;
  esac
}
compdef _orcactl orcactl
)sh";
}

}  // namespace

std::string help_text() {
  std::string text =
      "orcactl [--system NAME] COMMAND ...      look at a running system, and command it\n\n"
      "  orcactl ps                            what runs, and how it is\n"
      "  orcactl echo base.OdometryPush        the objects that pass a port\n"
      "  orcactl estop                         stop all motors now\n\nCommands\n";
  for (const Command& command : commands()) text += line_of(usage_of(command), command.text);
  text += "\nOptions\n";
  for (const OptionSpec& option : common_options()) text += line_of(usage_of(option), option.text);
  text += "\nexit";
  for (const char* const exit : kExits) text += std::string("    ") + exit + "\n    ";
  return text.substr(0, text.size() - 4);
}

std::string help_text(const Command& command) {
  std::string text = "orcactl " + usage_of(command) + "      " + std::string(command.text) + "\n";
  if (!command.details.empty()) text += "\n" + std::string(command.details) + "\n";
  if (!command.options.empty()) text += "\nOptions\n";
  for (const OptionSpec& option : command.options) text += line_of(usage_of(option), option.text);
  return text;
}

std::string man_page(const std::string& version) {
  std::string page =
      ".TH ORCACTL 1 \"\" \"Orca " + version +
      "\" \"User Commands\"\n.SH NAME\norcactl \\- look at a running Orca system, and command it\n"
      ".SH SYNOPSIS\n.B orcactl\n[\\-\\-system NAME] COMMAND ...\n.SH DESCRIPTION\n"
      "orcactl talks to the deployer that runs a graph, through a Unix socket of the same user. A system has "
      "the name of its graph.\n.SH COMMANDS\n";
  for (const Command& command : commands()) page += roff_command(command);
  page += ".SH OPTIONS\n";
  for (const OptionSpec& option : common_options()) page += roff_item(usage_of(option), option.text);
  page += ".SH EXIT STATUS\n";
  for (const char* const exit : kExits) page += roff_item(std::string(exit, 1), exit + 2);
  return page +
         ".SH FILES\n.TP\n.B $XDG_RUNTIME_DIR/orca/GRAPH.sock\nthe socket of a system; "
         "/tmp/orca\\-UID/GRAPH.sock where there is no such folder\n.SH SEE ALSO\n.BR deployer (1)\n";
}

std::string completion_script(const std::string& shell) {
  if (shell == "bash") return bash_script();
  return shell == "zsh" ? zsh_script() : "";
}

}  // namespace orca::orcactl
