// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "options.hpp"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "codes.hpp"
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
  bool repeats = false;  // it may be given several times
};

Error expected(const std::string& option, const std::string& what, const std::string& found) {
  return fail(Code::invalid_argument, option + " expects " + what + ", not " + in_quotes(found));
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

// Returns an option that asks for progress, or wants none. The two exclude each other.
Option progress(bool wanted) {
  return {false, [wanted](Options& options, const std::string&) {
            if (options.progress.value_or(wanted) != wanted)
              return Status(fail(Code::invalid_argument, "--progress and --no-progress exclude each other"));
            options.progress = wanted;
            return ok();
          }};
}

Status add_plugin_folder(Options& options, const std::string& folder) {
  std::error_code unknown;
  if (!std::filesystem::is_directory(folder, unknown))
    return expected("--plugins", "a folder with plugins", folder);
  options.plugin_folders.push_back(std::filesystem::absolute(folder).string());
  return ok();
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

// Reads COMPONENT=HOW@TIME.
Status add_failure(Options& options, const std::string& value) {
  const auto equals = value.find('=');
  const auto at = value.find('@', equals == std::string::npos ? 0 : equals);
  if (equals == std::string::npos || equals == 0 || at == std::string::npos)
    return expected("--fail", "COMPONENT=HOW@TIME, such as avoid=silent@20s", value);
  const std::string how = value.substr(equals + 1, at - equals - 1);
  const std::optional<host::Failure> failure = host::failure_from(how);
  if (!failure) return expected("--fail", listed(host::failure_names()) + " before the @", how);
  const Result<Duration> time = xml::parse_duration(value.substr(at + 1));
  if (!time) return fail(Code::invalid_argument, "--fail: " + time.error().message);
  for (const host::PlannedFailure& planned : options.run.planned_failures)
    if (planned.component == value.substr(0, equals))
      return fail(Code::invalid_argument, "--fail: " + in_quotes(planned.component) +
                                              " is to fail twice; a component fails in one way, at one time");
  options.run.planned_failures.push_back({value.substr(0, equals), *failure, *time});
  return ok();
}

// Reads FILE@TIME.
Status add_change(Options& options, const std::string& value) {
  const auto at = value.rfind('@');
  if (at == std::string::npos || at == 0)
    return expected("--change", "GRAPH@TIME, such as other.xml@20s", value);
  const Result<Duration> time = xml::parse_duration(value.substr(at + 1));
  if (!time) return fail(Code::invalid_argument, "--change: " + time.error().message);
  options.changes.push_back({value.substr(0, at), *time, {}});
  return ok();
}

Status set_trace(Options& options, const std::string& value) {
  if (value.empty()) return expected("--trace", "a file", value);
  options.run.trace_file = value;
  return ok();
}

Status set_picture(Options& options, const std::string& value) {
  if ((!value.ends_with(".svg") && !value.ends_with(".png")) || value.size() == 4)
    return expected("--picture", "a file ending in .svg or .png", value);
  options.run.picture.file = value;
  return ok();
}

// Reads FILE.csv=PORT,...
Status add_recording(Options& options, const std::string& value) {
  const auto equals = value.rfind('=');
  const std::string file = value.substr(0, equals);
  if (equals == std::string::npos || !file.ends_with(".csv") || file == ".csv")
    return expected("--record", "FILE.csv=PORT,..., such as poses.csv=localizer.RobotPosePush", value);
  for (const host::RecordingOptions& other : options.run.recordings)
    if (other.file == file)
      return fail(Code::invalid_argument, "--record: " + in_quotes(file) +
                                              " is given twice; name all its ports at once, with commas "
                                              "between");
  std::vector<std::string> ports;
  std::istringstream words(value.substr(equals + 1));
  for (std::string word; std::getline(words, word, ',');) ports.push_back(word);
  if (ports.empty()) return expected("--record", "a port after the =", value);
  options.run.recordings.push_back({file, std::move(ports)});
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

Status set_executor(Words& executor, const std::string& value) {
  if (value != "thread" && value != "fiber" && value != "baton")
    return expected("--executor", "thread, fiber or baton", value);
  executor = value;
  return ok();
}

std::map<std::string, Option> option_table(Words& executor) {
  return {
      {"--check", action(Action::check)},
      {"--print", action(Action::print)},
      {"--dot", action(Action::dot)},
      {"--mermaid", action(Action::mermaid)},
      {"--list-ports", action(Action::list_ports)},
      {"--diff", action(Action::diff)},
      {"--describe", action(Action::describe)},
      {"--types", action(Action::types)},
      {"--schema", action(Action::schema)},
      {"--help", action(Action::help)},
      {"-h", action(Action::help)},
      {"--version", action(Action::version)},
      {"--strict", flag(&Options::strict)},
      {"--json", flag(&Options::json)},
      {"--in-process", flag(&Options::in_process)},
      {"--hold", flag(&Options::hold)},
      {"--watch", flag(&Options::watch)},
      {"--stats", flag(&Options::stats)},
      {"--progress", progress(true)},
      {"--no-progress", progress(false)},
      {"--profile",
       {true, [](Options& o, const std::string& v) { return o.profiles.push_back(v), ok(); }, true}},
      {"--set", {true, [](Options& o, const std::string& v) { return o.settings.push_back(v), ok(); }, true}},
      {"--plugins", {true, add_plugin_folder, true}},
      {"--clock", {true, set_clock}},
      {"--machine", {true, [](Options& o, const std::string& v) { return o.machine = v, ok(); }}},
      {"--executor",
       {true, [&executor](Options&, const std::string& v) { return set_executor(executor, v); }}},
      {"--seed", {true, set_seed}},
      {"--until", {true, set_until}},
      {"--fail", {true, add_failure, true}},
      {"--change", {true, add_change, true}},
      {"--trace", {true, set_trace}},
      {"--values", {false, [](Options& o, const std::string&) { return o.run.trace_values = true, ok(); }}},
      {"--record", {true, add_recording, true}},
      {"--picture", {true, set_picture}},
      {"--view", {true, set_view}},
      {"--hide", {true, hide, true}},
      {"--log", {true, set_log}},
  };
}

Status choose_executor(Options& options, const Words& executor) {
  const bool is_virtual = options.run.executive.clock == ClockKind::virtual_time;
  const std::string name = executor.value_or(is_virtual ? "fiber" : "thread");
  options.chooses_executor = executor.has_value();
  if (name == "thread") {
    options.run.executive.backend = Backend::thread;
  } else if (name == "fiber") {
    options.run.executive.backend = Backend::fiber;
  } else {
    options.run.executive.backend = Backend::baton;
  }
  if (Result<std::unique_ptr<Executive>> tried = make_executive(options.run.executive); !tried)
    return tried.error();
  return ok();
}

bool takes_no_file(Action action) {
  return action == Action::help || action == Action::version || action == Action::types ||
         action == Action::schema;
}

bool speaks_json(Action action) {
  return action == Action::check || action == Action::print || action == Action::list_ports ||
         action == Action::diff || action == Action::describe || action == Action::types;
}

// Takes the files, once all options are read: the options decide how many are expected.
// @param guessing  some of them may be something else; a wrong number of files is not reported then.
Status take_files(Options& options, const std::vector<std::string>& files, bool guessing) {
  if (takes_no_file(options.action)) return ok();
  const std::size_t wanted = options.action == Action::diff ? 2 : 1;
  if (guessing && files.size() != wanted) return ok();
  if (files.empty())
    return fail(Code::invalid_argument, "no file given; try: deployer graphs/scout_goto.xml (or --help)");
  if (files.size() > wanted)
    return fail(Code::invalid_argument,
                std::string(wanted == 1 ? "one file only: there is" : "two files only:") + " " +
                    in_quotes(files[wanted - 1]) + " and " + in_quotes(files[wanted]));
  if (files.size() < wanted)
    return fail(Code::invalid_argument, "--diff compares two graphs: deployer --diff OLD.xml NEW.xml");
  options.file = files.front();
  if (wanted == 2) options.other_file = files.back();
  return ok();
}

Status check_json(const Options& options) {
  if (!options.json || speaks_json(options.action) || options.action == Action::help) return ok();
  return fail(Code::invalid_argument,
              "--json goes with --check, --print, --list-ports, --diff, --describe or --types");
}

Status check_values(const Options& options) {
  if (!options.run.trace_values || !options.run.trace_file.empty() || options.action == Action::help)
    return ok();
  return fail(Code::invalid_argument, "--values goes with --trace FILE");
}

// A reader of one command line. It reports everything that is wrong with it.
class Reader {
 public:
  Options read(const std::vector<std::string>& words) {
    options_.run.log_name = "deployer";
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (words[i].starts_with("-")) {
        take_option(words, i);
      } else {
        files_.push_back(words[i]);
      }
    }
    report(codes::kFiles, take_files(options_, files_, guessing_));
    report(codes::kExcluding, check_json(options_));
    report(codes::kExcluding, check_values(options_));
    // A wrong clock says nothing about which executors fit.
    if (!wrong_.contains("--clock")) report(codes::kExcluding, choose_executor(options_, executor_));
    return std::move(options_);
  }

 private:
  void report(const char* code, const Status& status) {
    if (!status.ok()) options_.problems.error(code, {"command line", 0, 0}, status.error().message);
  }
  void report(const char* code, const std::string& message) {
    report(code, fail(Code::invalid_argument, message));
  }

  // @param at  the number of the option's word; it is advanced to the option's value.
  void take_option(const std::vector<std::string>& words, std::size_t& at) {
    const std::string& word = words[at];
    const auto found = table_.find(word);
    if (found == table_.end()) return report_unknown(words, at);
    const Option& option = found->second;
    if (!option.takes_value) return report(codes::kExcluding, option.set(options_, {}));
    if (at + 1 == words.size()) return report(codes::kOptionValue, word + " expects a value (see --help)");
    const std::string& value = words[++at];
    const auto [before, fresh] = values_.emplace(word, value);
    if (!fresh && !option.repeats)
      return report(codes::kOptionTwice, word + " is given twice, as " + in_quotes(before->second) + " and " +
                                             in_quotes(value) + "; give it once");
    const Status taken = option.set(options_, value);
    if (!taken.ok()) wrong_.insert(word);
    report(codes::kOptionValue, taken);
  }

  void report_unknown(const std::vector<std::string>& words, std::size_t& at) {
    std::vector<std::string> names;
    for (const auto& [name, option] : table_) names.push_back(name);
    const auto near = xml::nearest_name(words[at], names);
    report(codes::kUnknownOption,
           "unknown option " + in_quotes(words[at]) + xml::did_you_mean(near) + " (see --help)");
    const bool value_follows = at + 1 < words.size() && !words[at + 1].starts_with("-");
    if (near && table_.at(*near).takes_value && value_follows) ++at;
    if (!near) guessing_ = true;
  }

  Options options_;
  Words executor_;
  const std::map<std::string, Option> table_ = option_table(executor_);
  std::map<std::string, std::string> values_;  // the first value of each option
  std::set<std::string> wrong_;                // options with a wrong value
  std::vector<std::string> files_;
  bool guessing_ = false;  // whether one of the files may be the value of an unknown option
};

}  // namespace

Options parse_options(const std::vector<std::string>& words) { return Reader().read(words); }

}  // namespace orca::deployer
