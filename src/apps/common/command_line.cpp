// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "command_line.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <span>
#include <sstream>

#include "manual.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"
#include "orca/xml/quantity.hpp"

namespace orca::apps {
namespace {

using Kind = Problem::Kind;

// Returns whether a word is an option: -0.3 and - are none.
bool is_option(const std::string& word) {
  return word.size() > 1 && word[0] == '-' &&
         (word[1] == '-' || std::isalpha(static_cast<unsigned char>(word[1])) != 0);
}

std::string range_of(const OptionSpec& option) {
  const std::string from = "an integer from " + std::to_string(option.least);
  return option.most == INT64_MAX ? from + " on" : from + " to " + std::to_string(option.most);
}

// Returns what the value of an option names, which must not be empty.
std::optional<std::string> named_by(const OptionSpec& option) {
  if (option.value == "FILE") return "a file";
  if (option.value == "DIR") return "a folder";
  return option.value == "NAME" || option.value == "USER" ? std::optional<std::string>("a name")
                                                          : std::nullopt;
}

// Returns what the value of an option must be, if it is not.
std::optional<std::string> expected_instead(const OptionSpec& option, const std::string& value) {
  if (option.value == "N") {
    const Result<std::int64_t> number = xml::parse_integer(value);
    if (!number || *number < option.least || *number > option.most) return range_of(option);
  } else if (const auto named = named_by(option); named) {
    if (value.empty()) return named;
  } else if (option.value == "FOLDER") {
    std::error_code unknown;
    if (!std::filesystem::is_directory(value, unknown)) return "a folder that exists";
  } else if (option.value.find('|') != std::string::npos) {
    const std::vector<std::string> choices = split(option.value, '|');
    if (std::ranges::find(choices, value) == choices.end())
      return joined(std::span(choices).first(choices.size() - 1), ", ") + " or " + choices.back();
  }
  return std::nullopt;
}

// Returns why the value of an option is wrong.
std::optional<std::string> fault_of(const OptionSpec& option, const std::string& value) {
  if (option.value == "DURATION") {
    const Result<Duration> read = xml::parse_duration(value);
    return read ? std::nullopt : std::optional(std::string(option.name) + ": " + read.error().message);
  }
  const auto expected = expected_instead(option, value);
  if (!expected) return std::nullopt;
  return std::string(option.name) + " expects " + *expected + ", not " + in_quotes(value);
}

// A reader of one command line.
class Reader {
 public:
  Reader(const Program& program, const std::vector<std::string>& words) : program_(program), words_(words) {}

  Call read() {
    for (; at_ < words_.size(); ++at_) is_option(words_[at_]) ? take_option() : take_word();
    if (!answers_by_itself(call_)) check_words();
    return std::move(call_);
  }

 private:
  void problem(Kind kind, const std::string& message) { call_.problems.push_back({kind, message}); }

  void take_word() {
    const std::string& word = words_[at_];
    const bool is_first = call_.command == nullptr && call_.words.empty();
    if (is_first) call_.command = program_.find(word);
    if (is_first && call_.command != nullptr) return;
    call_.words.push_back(word);
  }

  void take_option() {
    const std::string word = words_[at_] == "-h" ? "--help" : words_[at_];
    const std::vector<OptionSpec> known = options_of(program_, call_.command);
    const auto found = std::ranges::find(known, word, &OptionSpec::name);
    if (found == known.end()) return report_unknown(word, known);
    std::string value;
    if (!found->value.empty()) {
      if (at_ + 1 == words_.size())
        return problem(Kind::value,
                       word + " expects a value: " + std::string(found->value) + " (see --help)");
      value = words_[++at_];
      if (const auto fault = fault_of(*found, value)) return report_value(word, *fault);
    }
    keep(*found, value);
  }

  void report_value(const std::string& option, const std::string& fault) {
    call_.wrong.insert(option);
    problem(Kind::value, fault);
  }

  void keep(const OptionSpec& option, const std::string& value) {
    const auto before = call_.options.find(option.name);
    if (before == call_.options.end() || option.repeats) {
      call_.options.emplace(option.name, value);
    } else if (!option.value.empty()) {
      problem(Kind::twice, std::string(option.name) + " is given twice, as " + in_quotes(before->second) +
                               " and " + in_quotes(value) + "; give it once");
    }
  }

  void report_unknown(const std::string& word, const std::vector<OptionSpec>& known) {
    std::vector<std::string> names;
    for (const OptionSpec& option : known) names.emplace_back(option.name);
    const auto near = xml::nearest_name(word, names);
    const std::string of = call_.command == nullptr ? "" : " of " + std::string(call_.command->name);
    problem(Kind::unknown_option,
            "unknown option " + in_quotes(word) + of + xml::did_you_mean(near) + " (see --help)");
    // What follows may be its value, which is no further error.
    const bool takes_value = near && !std::ranges::find(known, *near, &OptionSpec::name)->value.empty();
    if (takes_value && at_ + 1 < words_.size() && !is_option(words_[at_ + 1])) ++at_;
    call_.guesses = call_.guesses || !near;
  }

  void check_words() {
    if (call_.command == nullptr && program_.arguments.empty()) return report_no_command();
    if (call_.command != nullptr) check_command(*call_.command);
    const std::vector<Argument>& arguments =
        call_.command == nullptr ? program_.arguments : call_.command->arguments;
    for (std::size_t i = 0; i < std::min(call_.words.size(), arguments.size()); ++i)
      check_file(arguments[i], call_.words[i]);
    if (!call_.guesses) check_count(arguments);
  }

  void check_command(const Command& command) {
    if (call_.has("--watch") && !command.watches)
      problem(Kind::words, caller() + " does not go with --watch");
    if (command.pairs && call_.words.size() > 2 && call_.words.size() % 2 != 0)
      problem(Kind::words, caller() + " needs a value after " + in_quotes(call_.words.back()));
  }

  void check_count(const std::vector<Argument>& arguments) {
    const auto needed = static_cast<std::size_t>(
        std::ranges::count_if(arguments, [](const Argument& argument) { return !argument.optional; }));
    const std::size_t count = call_.words.size();
    if (count < needed)
      problem(Kind::words, caller() + " needs " + std::string(arguments[count].name) + " (see --help)");
    const bool any = !arguments.empty() && arguments.back().repeats;
    if (!any && count > arguments.size())
      problem(Kind::words,
              caller() + " does not know what to do with " + in_quotes(call_.words[arguments.size()]));
  }

  [[nodiscard]] std::string caller() const {
    return std::string(call_.command == nullptr ? program_.name : call_.command->name);
  }

  void check_file(const Argument& argument, const std::string& word) {
    if (argument.names != Names::file || !(word.empty() || word.ends_with(':'))) return;
    problem(Kind::words,
            caller() + ": " + in_quotes(word) + " names no file" +
                (word.empty() ? "" : " and type; leave out the colon, or write the type after it"));
  }

  void report_no_command() {
    std::vector<std::string> names;
    for (const Command& command : program_.commands) names.emplace_back(command.name);
    if (call_.words.empty())
      return problem(Kind::words, "which command? for example: " + std::string(program_.name) + " " +
                                      names.front() + " (see --help)");
    problem(Kind::words, "unknown command " + in_quotes(call_.words.front()) +
                             xml::did_you_mean(xml::nearest_name(call_.words.front(), names)) +
                             " (see --help)");
  }

  const Program& program_;
  const std::vector<std::string>& words_;
  std::size_t at_ = 0;
  Call call_;
};

}  // namespace

const Command* Program::find(std::string_view command) const {
  const auto found = std::ranges::find(commands, command, &Command::name);
  return found == commands.end() ? nullptr : &*found;
}

std::optional<std::string> Call::text(std::string_view option) const {
  const auto found = options.find(option);
  return found == options.end() ? std::nullopt : std::optional(found->second);
}

std::optional<Duration> Call::duration(std::string_view option) const {
  const auto value = text(option);
  return value ? std::optional(xml::parse_duration(*value).value()) : std::nullopt;
}

std::optional<std::uint64_t> Call::count(std::string_view option) const {
  const auto value = text(option);
  return value ? std::optional(static_cast<std::uint64_t>(xml::parse_integer(*value).value())) : std::nullopt;
}

std::vector<std::string> Call::all(std::string_view option) const {
  std::vector<std::string> values;
  const auto [first, last] = options.equal_range(option);
  for (auto at = first; at != last; ++at) values.push_back(at->second);
  return values;
}

std::vector<std::string> Call::folders(std::string_view option) const {
  std::vector<std::string> folders = all(option);
  for (std::string& folder : folders) folder = std::filesystem::absolute(folder).string();
  return folders;
}

Call parse(const Program& program, const std::vector<std::string>& words) {
  return Reader(program, words).read();
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::istringstream words{std::string(text)};
  std::vector<std::string> parts;
  for (std::string part; std::getline(words, part, separator);) parts.push_back(part);
  return parts;
}

}  // namespace orca::apps
