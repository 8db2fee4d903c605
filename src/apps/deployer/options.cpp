// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "options.hpp"

#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"
#include "orca/xml/quantity.hpp"

namespace orca::deployer {
namespace {

using Setter = std::function<Status(Options&, const std::string&)>;

struct Option {
  bool takes_value;
  Setter set;
};

Error expected(const std::string& option, const std::string& what, const std::string& found) {
  return fail(Code::invalid_argument, option + " expects " + what + ", not \"" + found + "\"");
}

Option action(Options::Action action) {
  return {false, [action](Options& options, const std::string&) {
            options.action = action;
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
  options.run.picture_file = value;
  return ok();
}

Status set_log(Options& options, const std::string& value) {
  const Result<log::Level> level = log::parse_level(value);
  if (!level) return fail(Code::invalid_argument, "--log: " + level.error().message);
  options.log_level = *level;
  return ok();
}

// The executor is decided after all options are read, because its default depends on the clock.
using Words = std::optional<std::string>;

std::map<std::string, Option> option_table(Words& executor) {
  return {
      {"--check", action(Options::Action::check)},
      {"--print", action(Options::Action::print)},
      {"--describe", action(Options::Action::describe)},
      {"--help", action(Options::Action::help)},
      {"-h", action(Options::Action::help)},
      {"--version", action(Options::Action::version)},
      {"--profile", {true, [](Options& o, const std::string& v) { return o.profiles.push_back(v), ok(); }}},
      {"--set", {true, set_argument}},
      {"--clock", {true, set_clock}},
      {"--executor", {true, [&executor](Options&, const std::string& v) { return executor = v, ok(); }}},
      {"--seed", {true, set_seed}},
      {"--until", {true, set_until}},
      {"--trace", {true, [](Options& o, const std::string& v) { return o.run.trace_file = v, ok(); }}},
      {"--picture", {true, set_picture}},
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

bool needs_file(Options::Action action) {
  return action != Options::Action::help && action != Options::Action::version;
}

Status take_word(Options& options, const std::string& word) {
  if (!options.file.empty())
    return fail(Code::invalid_argument,
                "one file only: there is \"" + options.file + "\" and \"" + word + "\"");
  options.file = word;
  return ok();
}

}  // namespace

Result<Options> parse_options(const std::vector<std::string>& words) {
  Options options;
  Words executor;
  const std::map<std::string, Option> table = option_table(executor);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    Status taken;
    if (!word.starts_with("-")) {
      taken = take_word(options, word);
    } else if (const auto found = table.find(word); found == table.end()) {
      return unknown(word, table);
    } else if (found->second.takes_value && i + 1 == words.size()) {
      return fail(Code::invalid_argument, word + " expects a value (see --help)");
    } else {
      taken = found->second.set(options, found->second.takes_value ? words[++i] : std::string());
    }
    if (!taken.ok()) return taken.error();
  }
  if (needs_file(options.action) && options.file.empty())
    return fail(Code::invalid_argument, "no file given; try: deployer graphs/scout_goto.xml (or --help)");
  if (Status chosen = choose_executor(options, executor); !chosen.ok()) return chosen.error();
  return options;
}

const char* help_text() {
  return R"(deployer GRAPH.xml [options]      bring up the system that a graph describes, run it, take it down

  deployer graphs/scout_goto.xml                          in real time, with the graph's default profile
  deployer graphs/scout_goto.xml --clock virtual          the same run, as fast as the machine can
  deployer graphs/scout_goto.xml --check                  only say what is wrong with the graph

What to run
  --profile NAME        select a profile of the graph; may be repeated (default: the graph's default_profile)
  --set ARG=VALUE       set an <arg> of the graph; may be repeated
  --until DURATION      end after this time of the run's clock, e.g. 60s
  --seed N              seed of all random streams (default 1)

How to run it
  --clock KIND          steady: real time (default); virtual: simulated time, bit-identical for the same seed
  --executor KIND       thread (default of steady), fiber (default of virtual) or baton

What to write
  --trace FILE          one line per delivery, connection and change of state
  --picture FILE        what the world looked like in the end: .svg or .png
  --log LEVEL           debug, info (default), warning, error or off; logs go to stderr

Instead of running
  --check               check the graph against the plugins; all errors at once
  --print               the graph as it is after arguments and profiles
  --describe PLUGIN.so  ports and parameters of the types in a plugin
  --version, --help

stdout  arrived NAME x y t | contact NAME t | trace-hash HASH (virtual clock, last line)
exit    0 finished or stopped on request   1 failed while running   2 graph or arguments wrong, nothing started
        3 could not start, all taken down again
)";
}

}  // namespace orca::deployer
