// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "call.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/quantity.hpp"

namespace orca::orcactl {
namespace {

Error wrong(const std::string& what) { return fail(Code::invalid_argument, what); }

std::optional<std::uint64_t> read_count(const std::string& text) {
  std::uint64_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc{} || end != text.data() + text.size() || count == 0) return std::nullopt;
  return count;
}

Error unknown_command(const std::string& word) {
  std::vector<std::string> names;
  for (const Command& command : commands()) names.emplace_back(command.name);
  return wrong("unknown command " + in_quotes(word) + xml::did_you_mean(xml::nearest_name(word, names)) +
               " (see --help)");
}

// Checks the value of an option by what its name says that it is.
Status check_value(const OptionSpec& option, const std::string& value) {
  if (option.value == "DURATION") {
    if (const Result<Duration> read = xml::parse_duration(value); !read)
      return wrong(std::string(option.name) + ": " + read.error().message);
  } else if (option.value == "N" && !read_count(value)) {
    return wrong(std::string(option.name) + " expects a number above 0, found " + in_quotes(value));
  }
  return ok();
}

// A reader of one command line.
class Reader {
 public:
  Result<Call> read(const std::vector<std::string>& words) {
    for (std::size_t at = 0; at < words.size(); ++at)
      if (Status taken = take(words, at); !taken.ok()) return taken.error();
    if (call_.help) return std::move(call_);
    if (call_.command == nullptr) return wrong("which command? for example: orcactl ps (see --help)");
    if (call_.watch && !call_.command->watches)
      return wrong(std::string(call_.command->name) + " does not go with --watch");
    if (Status counted = check_arguments(); !counted.ok()) return counted.error();
    return std::move(call_);
  }

 private:
  Status take(const std::vector<std::string>& words, std::size_t& at) {
    const std::string& word = words[at];
    if (word.starts_with("--") || word == "-h") return take_option(words, at);
    if (call_.command == nullptr) {
      call_.command = find_command(word);
      return call_.command == nullptr ? Status(unknown_command(word)) : ok();
    }
    call_.words.push_back(word);
    return ok();
  }

  Status take_option(const std::vector<std::string>& words, std::size_t& at) {
    const std::string word = words[at] == "-h" ? "--help" : words[at];
    const OptionSpec* const option = find_option(word);
    if (option == nullptr) return unknown_option(word);
    std::string value;
    if (!option->value.empty()) {
      if (at + 1 == words.size()) return wrong(word + " expects a value: " + std::string(option->value));
      value = words[++at];
      if (Status fits = check_value(*option, value); !fits.ok()) return fits;
    }
    keep(*option, value);
    return ok();
  }

  void keep(const OptionSpec& option, const std::string& value) {
    const std::string name(option.name);
    if (name == "--system") call_.system = value;
    if (name == "--json") call_.json = true;
    if (name == "--watch") call_.watch = true;
    if (name == "--help") call_.help = true;
    if (std::ranges::find(common_options(), name, &OptionSpec::name) != common_options().end()) return;
    if (!option.repeats) call_.options.erase(name);
    call_.options.emplace(name, value);
  }

  [[nodiscard]] std::vector<OptionSpec> known_options() const {
    std::vector<OptionSpec> known(common_options().begin(), common_options().end());
    if (call_.command != nullptr)
      known.insert(known.end(), call_.command->options.begin(), call_.command->options.end());
    return known;
  }

  const OptionSpec* find_option(const std::string& word) {
    known_ = known_options();
    const auto found = std::ranges::find(known_, word, &OptionSpec::name);
    return found == known_.end() ? nullptr : &*found;
  }

  [[nodiscard]] Error unknown_option(const std::string& word) const {
    std::vector<std::string> names;
    for (const OptionSpec& option : known_) names.emplace_back(option.name);
    const std::string of = call_.command == nullptr ? "" : " of " + std::string(call_.command->name);
    return wrong("unknown option " + in_quotes(word) + of +
                 xml::did_you_mean(xml::nearest_name(word, names)) + " (see --help)");
  }

  [[nodiscard]] Status check_arguments() const {
    const std::vector<Argument>& arguments = call_.command->arguments;
    const bool any = !arguments.empty() && arguments.back().repeats;
    const auto needed = static_cast<std::size_t>(
        std::ranges::count_if(arguments, [](const Argument& argument) { return !argument.optional; }));
    const std::string command(call_.command->name);
    if (call_.words.size() < needed)
      return wrong(command + " needs " + std::string(arguments[call_.words.size()].name) + " (see orcactl " +
                   command + " --help)");
    for (std::size_t i = 0; i < call_.words.size() && i < arguments.size(); ++i)
      if (arguments[i].names == Names::file && (call_.words[i].empty() || call_.words[i].ends_with(':')))
        return wrong(
            command + ": " + in_quotes(call_.words[i]) + " names no file" +
            (call_.words[i].empty() ? "" : " and type; leave out the colon, or write the type after it"));
    if (call_.command->pairs && call_.words.size() % 2 != 0)
      return wrong(command + " needs a value after " + in_quotes(call_.words.back()));
    if (!any && call_.words.size() > arguments.size())
      return wrong(command + " does not know what to do with " + in_quotes(call_.words[arguments.size()]));
    return ok();
  }

  Call call_;
  std::vector<OptionSpec> known_;
};

}  // namespace

std::optional<Duration> Call::duration(std::string_view option) const {
  const auto found = options.find(option);
  if (found == options.end()) return std::nullopt;
  return xml::parse_duration(found->second).value();
}

std::optional<std::uint64_t> Call::count(std::string_view option) const {
  const auto found = options.find(option);
  return found == options.end() ? std::nullopt : read_count(found->second);
}

std::optional<std::string> Call::text(std::string_view option) const {
  const auto found = options.find(option);
  return found == options.end() ? std::nullopt : std::optional(found->second);
}

Result<Call> parse_call(const std::vector<std::string>& words) { return Reader().read(words); }

}  // namespace orca::orcactl
