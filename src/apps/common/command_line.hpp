// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
// The command line of a program as a table, from which it is parsed, explained and completed (manual.hpp).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/time.hpp"

namespace orca::apps {

/// What a word on the command line names, for completion.
enum class Names { none, component, group, port, param, process, system, file };

/// A word that is no option.
struct Argument {
  std::string_view name;  ///< In capitals: "PORT".
  Names names = Names::none;
  bool optional = false;
  bool repeats = false;  ///< The last one: any number of them.
};

/// An option. The name of its value says what the value must be: DURATION; N, a whole number from `least` to `most`; FILE
/// and DIR, any but ""; FOLDER, one that exists; words with '|' between them, one of these. The program checks any other
/// value itself.
struct OptionSpec {
  std::string_view name;       ///< "--follow"
  std::string_view value;      ///< "N"; empty: it has none.
  std::string_view text;       ///< For people.
  bool repeats = false;        ///< It may be given several times.
  std::string_view heading{};  ///< Begins a section of --help.
  std::int64_t least = 1;
  std::int64_t most = INT64_MAX;
};

/// A command of a program, its first word.
struct Command {
  std::string_view name;
  std::vector<Argument> arguments{};
  std::vector<OptionSpec> options{};  ///< Beyond those that all commands have.
  bool pairs = false;                 ///< Whether the words come in pairs.
  bool watches = false;               ///< Whether --watch makes sense.
  std::string_view text;              ///< One line for people.
  std::string_view details{};         ///< More, for the man page.
};

/// A program.
struct Program {
  std::string_view name;
  std::string_view usage;             ///< What follows its name.
  std::string_view text;              ///< One line for people.
  std::string_view details;           ///< Examples and more, of several lines.
  std::vector<Argument> arguments{};  ///< Of a call without a command; none: it needs a command.
  std::vector<Command> commands{};
  std::vector<OptionSpec> options{};    ///< Of all calls.
  std::vector<std::string_view> exits;  ///< "0 done"
  std::string_view notes{};             ///< The end of --help.

  /// Returns a command; null if there is none of that name.
  [[nodiscard]] const Command* find(std::string_view command) const;
};

/// Something wrong with a command line.
struct Problem {
  enum class Kind { unknown_option, value, twice, words };
  Kind kind = Kind::words;
  std::string message;  ///< With what would be right.
};

/// A call of a program, as the command line says it. A plain value.
struct Call {
  const Command* command = nullptr;  ///< Null: none.
  std::vector<std::string> words;    ///< The arguments.
  /// The options by their names, "" for those without a value. Values that the table describes are right.
  std::multimap<std::string, std::string, std::less<>> options;
  std::vector<Problem> problems;
  std::set<std::string, std::less<>> wrong;  ///< Options with a wrong value.
  bool guesses =
      false;  ///< One of the words may be the value of an unknown option, so their number is not judged.

  [[nodiscard]] bool has(std::string_view option) const { return options.contains(option); }
  /// Returns whether the value of an option is wrong, which is among the problems.
  [[nodiscard]] bool is_wrong(std::string_view option) const { return wrong.contains(option); }
  [[nodiscard]] std::optional<std::string> text(std::string_view option) const;
  [[nodiscard]] std::optional<Duration> duration(std::string_view option) const;
  [[nodiscard]] std::optional<std::uint64_t> count(std::string_view option) const;
  /// Returns all values of an option that repeats, in their order.
  [[nodiscard]] std::vector<std::string> all(std::string_view option) const;
  /// Returns the values of a repeated FOLDER, absolute.
  [[nodiscard]] std::vector<std::string> folders(std::string_view option) const;
};

/// Reads a command line, and reports all that is wrong with it. Numbers of words are not checked where help is asked for.
/// @param words  without the program's name.
[[nodiscard]] Call parse(const Program& program, const std::vector<std::string>& words);

/// Returns the parts of a text with `separator` between them.
[[nodiscard]] std::vector<std::string> split(std::string_view text, char separator);

}  // namespace orca::apps
