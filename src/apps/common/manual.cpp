// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "manual.hpp"

#include <algorithm>
#include <utility>

namespace orca::apps {
namespace {

constexpr std::size_t kColumn = 34;  // of the second column of --help
constexpr std::size_t kWidth = 120;  // of a line

// What every program has.
const std::vector<OptionSpec>& usual_options() {
  static const std::vector<OptionSpec> all{
      {"--help", "", "this text, or that of a command", false, "About the program"},
      {"--version", "", "the version of Orca"},
      {"--man", "", "the man page, for man -l -"},
      {"--completion", "bash|zsh", "the completion script of a shell, to be sourced by it"}};
  return all;
}

std::string usage_of(const std::vector<Argument>& arguments) {
  std::string usage;
  for (const Argument& argument : arguments) {
    const std::string name = std::string(argument.name) + (argument.repeats ? "..." : "");
    usage += " " + (argument.optional ? "[" + name + "]" : name);
  }
  return usage;
}

std::string usage_of(const Command& command) {
  return std::string(command.name) + usage_of(command.arguments);
}

std::string usage_of(const OptionSpec& option) {
  return std::string(option.name) + (option.value.empty() ? "" : " " + std::string(option.value));
}

std::string text_of(const OptionSpec& option) {
  return std::string(option.text) + (option.repeats ? "; may be repeated" : "");
}

// Returns a text in lines, the first of which begins with `line` and all others with `indent` blanks.
std::string wrapped(std::string line, std::size_t indent, std::string_view text) {
  std::string result;
  for (const std::string& word : split(text, ' ')) {
    if (line.size() + word.size() > kWidth) {
      result += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
      line = std::string(indent, ' ');
    }
    line += word + " ";
  }
  return result + line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
}

// Returns a line of two columns. A long text goes on in the second one.
std::string row(const std::string& what, const std::string& text) {
  std::string line = "  " + what;
  line.resize(std::max(kColumn, line.size() + 2), ' ');
  return wrapped(std::move(line), kColumn, text);
}

std::string rows(const std::vector<OptionSpec>& options) {
  std::string text;
  for (const OptionSpec& option : options) {
    if (!option.heading.empty()) text += "\n" + std::string(option.heading) + "\n";
    text += row(usage_of(option), text_of(option));
  }
  return text;
}

// Returns a text with what roff would obey made harmless.
std::string roff(std::string_view text) {
  std::string safe;
  for (const std::string& line : split(text, '\n')) {
    std::string harmless;
    for (const char c : line) {
      if (c == '\\') harmless += '\\';
      harmless += c == '-' ? std::string("\\-") : std::string(1, c);
    }
    if (harmless.starts_with('.') || harmless.starts_with('\'')) harmless.insert(0, "\\&");
    safe += (safe.empty() ? "" : "\n") + harmless;
  }
  return safe;
}

std::string roff_item(const std::string& what, std::string_view text) {
  return ".TP\n.B " + roff(what) + "\n" + roff(text) + "\n";
}

std::string roff_command(const Command& command) {
  std::string page = roff_item(usage_of(command), command.text);
  if (!command.details.empty()) page += ".IP\n" + roff(command.details) + "\n";
  for (const OptionSpec& option : command.options)
    page += ".IP\n" + roff(usage_of(option) + ": " + text_of(option)) + "\n";
  return page;
}

std::string names_of(const Program& program, const Command* command) {
  std::string names;
  for (const OptionSpec& option : options_of(program, command))
    if (command == nullptr || command->watches || option.name != "--watch")
      names += (names.empty() ? "" : " ") + std::string(option.name);
  return names;
}

std::string kind_of(const Command& command) {
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

std::string replaced(std::string text, std::string_view mark, const std::string& by) {
  for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + by.size()))
    text.replace(at, mark.size(), by);
  return text;
}

// The cases of a shell's "case $before in": what may follow an option. "@ADD" stands for how the shell takes words.
std::string value_cases(const Program& program) {
  std::vector<OptionSpec> all = options_of(program, nullptr);
  for (const Command& command : program.commands)
    all.insert(all.end(), command.options.begin(), command.options.end());
  std::string cases;
  for (const OptionSpec& option : all)
    if (option.value.find('|') != std::string_view::npos)
      cases += "  " + std::string(option.name) + ") @ADD " + replaced(std::string(option.value), "|", " ") +
               "; return ;;\n";
  return cases;
}

// The options and the kind of name of each command, the same for both shells.
std::string command_cases(const Program& program) {
  std::string cases;
  for (const Command& command : program.commands)
    cases += "  " + std::string(command.name) + ") options=\"" + names_of(program, &command) + "\"; kind=\"" +
             kind_of(command) + "\" ;;\n";
  return cases;
}

std::string command_words(const Program& program) {
  std::string words;
  for (const Command& command : program.commands) words += " " + std::string(command.name);
  return words;
}

// The script of both shells: they differ in how a word of the command line is called and how possible words are added.
constexpr const char* kScript = R"sh(@HEAD
_@NAME_add() { @TAKE; }
_@NAME() {
  local word=@WORD before=@BEFORE command= system= options="@OPTIONS" kind= i
  for ((i = @FIRST; i < @END; ++i)); do
    case @AT in
    --system) ((++i)); system=@AT ;;
    -*) ;;
    *) command=@AT; break ;;
    esac
  done
  case $before in
  --system) @ADD $(@NAME names system 2>/dev/null); return ;;
@VALUES  esac
  if [[ -z $command ]]; then @ADD@COMMANDS $options; return; fi
  case $command in
@CASES  esac
  if [[ $word == -* ]]; then @ADD $options
  elif [[ -n $kind ]]; then @ADD $(@NAME ${system:+--system} ${system:+"$system"} names $kind 2>/dev/null)
  fi
}
@TAIL
)sh";

}  // namespace

std::vector<OptionSpec> options_of(const Program& program, const Command* command) {
  std::vector<OptionSpec> all;
  if (command != nullptr) all = command->options;
  all.insert(all.end(), program.options.begin(), program.options.end());
  all.insert(all.end(), usual_options().begin(), usual_options().end());
  return all;
}

bool answers_by_itself(const Call& call) {
  return std::ranges::any_of(usual_options(),
                             [&](const OptionSpec& option) { return call.has(option.name); });
}

std::optional<std::string> answer(const Program& program, const Call& call) {
  if (call.has("--help"))
    return call.command == nullptr ? help_text(program) : help_text(program, *call.command);
  if (call.has("--version")) return "orca " + std::string(program.name) + " " ORCA_VERSION "\n";
  if (call.has("--man")) return man_page(program);
  if (const auto shell = call.text("--completion")) return completion_script(program, *shell);
  return std::nullopt;
}

std::string help_text(const Program& program) {
  std::string text = std::string(program.name) + " " + std::string(program.usage) + "      " +
                     std::string(program.text) + "\n\n" + std::string(program.details);
  if (!program.commands.empty()) text += "\nCommands\n";
  for (const Command& command : program.commands) text += row(usage_of(command), std::string(command.text));
  text += rows(options_of(program, nullptr)) + "\nExit status\n";
  for (const std::string_view exit : program.exits) text += "  " + std::string(exit) + "\n";
  return text + std::string(program.notes);
}

std::string help_text(const Program& program, const Command& command) {
  std::string text =
      wrapped(std::string(program.name) + " " + usage_of(command) + "      ", kColumn, command.text);
  if (!command.details.empty()) text += "\n" + wrapped("", 0, command.details);
  if (!command.options.empty()) text += "\nOptions\n" + rows(command.options);
  return text;
}

std::string man_page(const Program& program) {
  std::string capitals(program.name);
  std::ranges::transform(capitals, capitals.begin(), [](char c) { return static_cast<char>(c - 'a' + 'A'); });
  std::string page = ".TH " + capitals + " 1 \"\" \"Orca " ORCA_VERSION "\" \"User Commands\"\n.SH NAME\n" +
                     std::string(program.name) + " \\- " + roff(program.text) + "\n.SH SYNOPSIS\n.B " +
                     std::string(program.name) + "\n" + roff(program.usage) + "\n.SH DESCRIPTION\n.nf\n" +
                     roff(program.details) + "\n.fi\n";
  if (!program.commands.empty()) page += ".SH COMMANDS\n";
  for (const Command& command : program.commands) page += roff_command(command);
  page += ".SH OPTIONS\n";
  for (const OptionSpec& option : options_of(program, nullptr))
    page += roff_item(usage_of(option), text_of(option));
  page += ".SH EXIT STATUS\n";
  for (const std::string_view exit : program.exits)
    page += roff_item(std::string(exit.substr(0, 1)), exit.substr(2));
  return page + (program.notes.empty() ? "" : ".SH NOTES\n.nf\n" + roff(program.notes) + "\n.fi\n");
}

std::string completion_script(const Program& program, const std::string& shell) {
  const bool is_bash = shell == "bash";
  const std::pair<const char*, std::string> parts[] = {
      {"@HEAD", is_bash ? "# bash completion of @NAME, made by: @NAME --completion bash"
                        : "#compdef @NAME\n# zsh completion of @NAME, made by: @NAME --completion zsh"},
      {"@TAKE",
       is_bash ? R"(COMPREPLY=($(compgen -W "$*" -- "${COMP_WORDS[COMP_CWORD]}")))" : R"(compadd -- ${=@})"},
      {"@WORD", is_bash ? "${COMP_WORDS[COMP_CWORD]}" : "${words[CURRENT]}"},
      {"@BEFORE", is_bash ? "${COMP_WORDS[COMP_CWORD-1]}" : "${words[CURRENT-1]}"},
      {"@FIRST", is_bash ? "1" : "2"},
      {"@END", is_bash ? "COMP_CWORD" : "CURRENT"},
      {"@AT", is_bash ? "${COMP_WORDS[i]}" : "${words[i]}"},
      {"@TAIL", is_bash ? "complete -o default -F _@NAME @NAME" : "compdef _@NAME @NAME"},
      {"@OPTIONS", names_of(program, nullptr)},
      {"@VALUES", value_cases(program)},
      {"@COMMANDS", command_words(program)},
      {"@CASES", command_cases(program)},
      {"@ADD", "_@NAME_add"},
      {"@NAME", std::string(program.name)}};
  std::string script = kScript;
  for (const auto& [mark, by] : parts) script = replaced(script, mark, by);
  return script;
}

}  // namespace orca::apps
