// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "options.hpp"

#include <functional>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"
#include "orca/xml/quantity.hpp"

namespace orca::deployer {
namespace {

using Action = Options::Action;
using Setter = std::function<Status(Options&, const std::string&)>;

struct Option {
  bool takes_value;
  Setter set;
};

Error expected(const std::string& option, const std::string& what, const std::string& found) {
  return fail(Code::invalid_argument, option + " expects " + what + ", not \"" + found + "\"");
}

// Returns an option that chooses what to do. Help takes precedence; any other two actions exclude each other.
Option action(Options::Action action) {
  return {false, [action](Options& options, const std::string&) {
            const bool asks_for_help = options.action == Action::help || action == Action::help;
            if (options.action != Action::run && options.action != action && !asks_for_help)
              return Status(fail(Code::invalid_argument,
                                 "one thing to do only, two are given; --help lists them under \"Instead of "
                                 "running\""));
            options.action = asks_for_help ? Action::help : action;
            return ok();
          }};
}

Option flag(bool Options::*member) {
  return {false, [member](Options& options, const std::string&) {
            options.*member = true;
            return ok();
          }};
}

Status set_clock(Options& options, const std::string& value) {
  if (value != "steady" && value != "virtual") return expected("--clock", "steady or virtual", value);
  options.run.executive.clock = value == "steady" ? ClockKind::steady : ClockKind::virtual_time;
  return ok();
}

Status set_seed(Options& options, const std::string& value) {
  const Result<std::int64_t> seed = xml::parse_integer(value);
  if (!seed || *seed < 0) return expected("--seed", "an integer from 0 on", value);
  options.run.seed = static_cast<std::uint64_t>(*seed);
  return ok();
}

Status set_until(Options& options, const std::string& value) {
  const Result<Duration> until = xml::parse_duration(value);
  if (!until) return fail(Code::invalid_argument, "--until: " + until.error().message);
  options.run.until = *until;
  return ok();
}

Status set_argument(Options& options, const std::string& value) {
  const auto equals = value.find('=');
  if (equals == std::string::npos || equals == 0) return expected("--set", "ARG=VALUE", value);
  options.settings.push_back(value);
  return ok();
}

Status set_picture(Options& options, const std::string& value) {
  if (!value.ends_with(".svg") && !value.ends_with(".png"))
    return expected("--picture", "a file ending in .svg or .png", value);
  options.run.picture.file = value;
  return ok();
}

Status set_view(Options& options, const std::string& value) {
  const std::optional<host::View> view = host::view_from(value);
  if (!view) return expected("--view", listed(host::view_names()), value);
  options.run.picture.view = *view;
  return ok();
}

Status hide(Options& options, const std::string& value) {
  std::istringstream words(value);
  for (std::string word; std::getline(words, word, ',');) {
    const std::optional<host::Layer> layer = host::layer_from(word);
    if (!layer)
      return expected("--hide", "some of " + listed(host::layer_names()) + ", with commas between", word);
    options.run.picture.hidden.insert(*layer);
  }
  return ok();
}

Status set_log(Options& options, const std::string& value) {
  const Result<log::Level> level = log::parse_level(value);
  if (!level) return fail(Code::invalid_argument, "--log: " + level.error().message);
  options.log_level = *level;
  return ok();
}

// The executor is chosen after all options are read, because its default depends on the clock.
using Words = std::optional<std::string>;

std::map<std::string, Option> option_table(Words& executor) {
  return {
      {"--check", action(Action::check)},
      {"--print", action(Action::print)},
      {"--dot", action(Action::dot)},
      {"--mermaid", action(Action::mermaid)},
      {"--list-ports", action(Action::list_ports)},
      {"--diff", action(Action::diff)},
      {"--describe", action(Action::describe)},
      {"--schema", action(Action::schema)},
      {"--help", action(Action::help)},
      {"-h", action(Action::help)},
      {"--version", action(Action::version)},
      {"--strict", flag(&Options::strict)},
      {"--json", flag(&Options::json)},
      {"--stats", flag(&Options::stats)},
      {"--profile", {true, [](Options& o, const std::string& v) { return o.profiles.push_back(v), ok(); }}},
      {"--set", {true, set_argument}},
      {"--clock", {true, set_clock}},
      {"--executor", {true, [&executor](Options&, const std::string& v) { return executor = v, ok(); }}},
      {"--seed", {true, set_seed}},
      {"--until", {true, set_until}},
      {"--trace", {true, [](Options& o, const std::string& v) { return o.run.trace_file = v, ok(); }}},
      {"--picture", {true, set_picture}},
      {"--view", {true, set_view}},
      {"--hide", {true, hide}},
      {"--log", {true, set_log}},
  };
}

Status choose_executor(Options& options, const Words& executor) {
  const bool is_virtual = options.run.executive.clock == ClockKind::virtual_time;
  const std::string name = executor.value_or(is_virtual ? "fiber" : "thread");
  if (name == "thread") {
    options.run.executive.backend = Backend::thread;
  } else if (name == "fiber") {
    options.run.executive.backend = Backend::fiber;
  } else if (name == "baton") {
    options.run.executive.backend = Backend::baton;
  } else {
    return expected("--executor", "thread, fiber or baton", name);
  }
  if (Result<std::unique_ptr<Executive>> tried = make_executive(options.run.executive); !tried)
    return tried.error();
  return ok();
}

Error unknown(const std::string& word, const std::map<std::string, Option>& table) {
  std::vector<std::string> names;
  for (const auto& [name, option] : table) names.push_back(name);
  return fail(Code::invalid_argument, "unknown option \"" + word + "\"" +
                                          xml::did_you_mean(xml::nearest_name(word, names)) +
                                          " (see --help)");
}

bool takes_no_file(Action action) {
  return action == Action::help || action == Action::version || action == Action::schema;
}

bool speaks_json(Action action) {
  return action == Action::check || action == Action::print || action == Action::list_ports ||
         action == Action::diff || action == Action::describe;
}

// Takes the files, once all options are read: the options decide how many are expected.
Status take_files(Options& options, const std::vector<std::string>& files) {
  if (takes_no_file(options.action)) return ok();
  const std::size_t wanted = options.action == Action::diff ? 2 : 1;
  if (files.empty())
    return fail(Code::invalid_argument, "no file given; try: deployer graphs/scout_goto.xml (or --help)");
  if (files.size() > wanted)
    return fail(Code::invalid_argument,
                std::string(wanted == 1 ? "one file only: there is" : "two files only:") + " \"" +
                    files[wanted - 1] + "\" and \"" + files[wanted] + "\"");
  if (files.size() < wanted)
    return fail(Code::invalid_argument, "--diff compares two graphs: deployer --diff OLD.xml NEW.xml");
  options.file = files.front();
  if (wanted == 2) options.other_file = files.back();
  return ok();
}

Status check_json(const Options& options) {
  if (!options.json || speaks_json(options.action) || options.action == Action::help) return ok();
  return fail(Code::invalid_argument,
              "--json goes with --check, --print, --list-ports, --diff or --describe");
}

}  // namespace

Result<Options> parse_options(const std::vector<std::string>& words) {
  Options options;
  options.run.log_name = "deployer";
  Words executor;
  std::vector<std::string> files;
  const std::map<std::string, Option> table = option_table(executor);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    Status taken;
    if (!word.starts_with("-")) {
      files.push_back(word);
    } else if (const auto found = table.find(word); found == table.end()) {
      return unknown(word, table);
    } else if (found->second.takes_value && i + 1 == words.size()) {
      return fail(Code::invalid_argument, word + " expects a value (see --help)");
    } else {
      taken = found->second.set(options, found->second.takes_value ? words[++i] : std::string());
    }
    if (!taken.ok()) return taken.error();
  }
  if (Status taken = take_files(options, files); !taken.ok()) return taken.error();
  if (Status checked = check_json(options); !checked.ok()) return checked.error();
  if (Status chosen = choose_executor(options, executor); !chosen.ok()) return chosen.error();
  return options;
}

}  // namespace orca::deployer
