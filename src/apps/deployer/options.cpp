// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "options.hpp"

#include <optional>
#include <set>
#include <utility>

#include "codes.hpp"
#include "common/command_line.hpp"
#include "common/manual.hpp"
#include "orca/base/files/own_library.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/number.hpp"
#include "orca/xml/quantity.hpp"
#include "orca/xml/values.hpp"

namespace orca::deployer {
namespace {

using Action = Options::Action;

constexpr std::pair<const char*, Action> kActions[] = {
    {"--check", Action::check},       {"--print", Action::print},
    {"--dot", Action::dot},           {"--mermaid", Action::mermaid},
    {"--diff", Action::diff},         {"--list-ports", Action::list_ports},
    {"--describe", Action::describe}, {"--types", Action::types},
    {"--schema", Action::schema},     {"--rnc", Action::rnc}};

Error wrong(const std::string& what) { return fail(Code::invalid_argument, what); }

Error expected(const std::string& option, const std::string& what, const std::string& found) {
  return wrong(option + " expects " + what + ", not " + in_quotes(found));
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
  if (!time) return wrong("--fail: " + time.error().message);
  for (const host::PlannedFailure& planned : options.run.planned_failures)
    if (planned.component == value.substr(0, equals))
      return wrong("--fail: " + in_quotes(planned.component) +
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
  if (!time) return wrong("--change: " + time.error().message);
  options.changes.push_back({value.substr(0, at), *time, {}});
  return ok();
}

// Reads FILE.csv=PORT,... or FILE.mcap[=PORT,...] or FILE.carmen[=PORT,...]
Status add_recording(Options& options, const std::string& value) {
  const bool is_whole_bag = host::is_bag_file(value);
  const auto equals = is_whole_bag ? std::string::npos : value.rfind('=');
  const std::string file = value.substr(0, equals);
  const bool is_table = file.ends_with(".csv") && file != ".csv" && equals != std::string::npos;
  if (!is_table && (!host::is_bag_file(file) || file == ".mcap" || file == ".carmen"))
    return expected("--record",
                    "FILE.csv=PORT,..., such as poses.csv=localizer.RobotPosePush, or FILE.mcap, or "
                    "FILE.mcap=PORT,..., and likewise FILE.carmen",
                    value);
  for (const host::RecordingOptions& other : options.run.recordings)
    if (other.file == file)
      return wrong("--record: " + in_quotes(file) +
                   " is given twice; name all its ports at once, with commas between");
  std::vector<std::string> ports =
      is_whole_bag ? std::vector<std::string>{} : apps::split(value.substr(equals + 1), ',');
  if (ports.empty() && !is_whole_bag) return expected("--record", "a port after the =", value);
  options.run.recordings.push_back({file, std::move(ports)});
  return ok();
}

Status set_picture(Options& options, const std::string& value) {
  if ((!value.ends_with(".svg") && !value.ends_with(".png")) || value.size() == 4)
    return expected("--picture", "a file ending in .svg or .png", value);
  options.run.picture.file = value;
  return ok();
}

Status hide(Options& options, const std::string& value) {
  for (const std::string& word : apps::split(value, ',')) {
    const std::optional<host::Layer> layer = host::layer_from(word);
    if (!layer)
      return expected("--hide", "some of " + listed(host::layer_names()) + ", with commas between", word);
    options.run.picture.hidden.insert(*layer);
  }
  return ok();
}

Status set_computing(Options& options, const std::string& value) {
  constexpr xml::ValueRule kFactor{.form = xml::ValueRule::Form::number, .min = 0.0, .max = 1e6};
  xml::ValueFault fault;
  const std::optional<double> factor = xml::read_number(value, kFactor, fault);
  if (!factor) return wrong("--computing: " + fault.message);
  options.run.computing = *factor;
  return ok();
}

Status set_pace(Options& options, const std::string& value) {
  constexpr xml::ValueRule kFactor{.form = xml::ValueRule::Form::number, .min = 0.0, .max = Pace::kFastest};
  xml::ValueFault fault;
  options.pace = value == "fast" ? Pace::kFast : xml::read_number(value, kFactor, fault);
  if (!options.pace) return wrong("--pace: " + fault.message + "; or write \"fast\"");
  const Status fits = Pace(1.0).set(*options.pace);
  return fits.ok() ? fits : wrong("--pace: " + fits.error().message);
}

// Reads FD or FD,FD.
Status set_guest(Options& options, const std::string& value) {
  const std::vector<std::string> words = apps::split(value, ',');
  std::vector<int> sockets;
  for (const std::string& word : words)
    if (const Result<std::int64_t> number = xml::parse_integer(word);
        number && *number > 2 && *number < 65536)
      sockets.push_back(static_cast<int>(*number));
  if (sockets.empty() || sockets.size() != words.size() || sockets.size() > 2)
    return expected("--guest", "one or two open sockets, such as 5 or 5,6", value);
  options.guest_socket = sockets.front();
  if (sockets.size() == 2) options.steering_socket = sockets.back();
  return ok();
}

// Options whose values the table does not describe.
using Setter = Status (*)(Options&, const std::string&);
Status add_grant(Options& options, const std::string& value) {
  const Result<supervisor::Grant> grant = supervisor::read_grant(value);
  if (!grant) return wrong("--allow: " + grant.error().message);
  options.grants.push_back(*grant);
  return ok();
}

constexpr std::pair<const char*, Setter> kOfOwnForm[] = {
    {"--computing", set_computing}, {"--pace", set_pace},     {"--guest", set_guest},
    {"--fail", add_failure},        {"--change", add_change}, {"--record", add_recording},
    {"--picture", set_picture},     {"--hide", hide},         {"--allow", add_grant}};

const char* code_of(apps::Problem::Kind kind) {
  switch (kind) {
    case apps::Problem::Kind::unknown_option: return codes::kUnknownOption;
    case apps::Problem::Kind::value: return codes::kOptionValue;
    case apps::Problem::Kind::twice: return codes::kOptionTwice;
    case apps::Problem::Kind::words: return codes::kFiles;
  }
  return codes::kFiles;
}

// A reader of one call. It reports everything that is wrong with it.
class Reader {
 public:
  explicit Reader(const apps::Call& call) : call_(call) {}

  Options read() {
    for (const apps::Problem& problem : call_.problems) report(code_of(problem.kind), wrong(problem.message));
    options_.answer = apps::answer(program(), call_);
    if (options_.answer) return std::move(options_);
    take_flags();
    take_values();
    for (const auto& [name, set] : kOfOwnForm)
      for (const std::string& value : call_.all(name)) report(codes::kOptionValue, set(options_, value));
    choose_action();
    report(codes::kFiles, take_files());
    check_company();
    check_company_of_guests();
    report(codes::kExcluding, choose_executor());
    return std::move(options_);
  }

 private:
  void report(const char* code, const Status& status) {
    if (!status.ok()) options_.problems.error(code, {"command line", 0, 0}, status.error().message);
  }

  void take_flags() {
    options_.strict = call_.has("--strict");
    options_.json = call_.has("--json");
    options_.in_process = call_.has("--in-process");
    options_.hold = call_.has("--hold");
    options_.watch = call_.has("--watch");
    options_.view = call_.has("--view");
    options_.stats = call_.has("--stats");
    options_.run.trace_values = call_.has("--values");
    if (call_.has("--progress") || call_.has("--no-progress")) options_.progress = call_.has("--progress");
  }

  void take_values() {
    options_.run.log_name = "deployer";
    options_.profiles = call_.all("--profile");
    options_.writable = call_.all("--writable");
    options_.settings = call_.all("--set");
    options_.plugin_folders = call_.folders("--plugins");
    options_.machine = call_.text("--machine").value_or("");
    options_.name = call_.text("--name").value_or("");
    if (const auto domain = call_.count("--domain")) options_.domain = static_cast<std::uint32_t>(*domain);
    options_.run.until = call_.duration("--until");
    options_.run.seed = call_.count("--seed");
    options_.laps_file = call_.text("--measure-laps").value_or("");
    options_.run.measures_laps = !options_.laps_file.empty();
    options_.run.trace_file = call_.text("--trace").value_or("");
    if (const auto view = call_.text("--scene")) options_.run.picture.view = *host::view_from(*view);
    if (const auto level = call_.text("--log")) options_.log_level = *log::parse_level(*level);
    if (call_.text("--clock") == "virtual") options_.run.executive.clock = ClockKind::virtual_time;
  }

  void choose_action() {
    for (const auto& [name, action] : kActions) {
      if (!call_.has(name)) continue;
      if (options_.action != Action::run)
        return report(codes::kExcluding, wrong("one thing to do only, two are given; --help lists them under "
                                               "\"Instead of running\""));
      options_.action = action;
    }
  }

  // Takes the files; the action decides how many are expected.
  Status take_files() {
    if (options_.action == Action::types || options_.action == Action::schema ||
        options_.action == Action::rnc)
      return ok();
    const std::vector<std::string>& files = call_.words;
    const std::size_t wanted = options_.action == Action::diff ? 2 : 1;
    if (call_.guesses && files.size() != wanted) return ok();
    if (files.empty()) return wrong("no file given; try: deployer graphs/scout_goto.xml (or --help)");
    if (files.size() > wanted)
      return wrong(std::string(wanted == 1 ? "one file only: there is" : "two files only:") + " " +
                   in_quotes(files[wanted - 1]) + " and " + in_quotes(files[wanted]));
    if (files.size() < wanted) return wrong("--diff compares two graphs: deployer --diff OLD.xml NEW.xml");
    options_.file = or_own_file(files.front());
    if (wanted == 2) options_.other_file = or_own_file(files.back());
    return ok();
  }

  // Reports options that go only with others, or not with others.
  void check_company() {
    static const std::set<Action> kSpeakJson{Action::check, Action::print,    Action::list_ports,
                                             Action::diff,  Action::describe, Action::types};
    if (options_.json && !kSpeakJson.contains(options_.action))
      report(codes::kExcluding,
             wrong("--json goes with --check, --print, --list-ports, --diff, --describe or --types"));
    if (call_.has("--computing") && options_.run.executive.clock != ClockKind::virtual_time)
      report(codes::kExcluding,
             wrong("--computing goes with --clock virtual: in real time the machine computes"));
    if (options_.pace && options_.run.executive.clock != ClockKind::virtual_time)
      report(codes::kExcluding, wrong("--pace goes with --clock virtual: real time has its own"));
    if (options_.run.trace_values && options_.run.trace_file.empty())
      report(codes::kExcluding, wrong("--values goes with --trace FILE"));
    if (call_.has("--progress") && call_.has("--no-progress"))
      report(codes::kExcluding, wrong("--progress and --no-progress exclude each other"));
  }

  void check_company_of_guests() {
    if (options_.guest_socket >= 0 && options_.action != Action::check &&
        options_.run.executive.clock != ClockKind::virtual_time)
      report(codes::kExcluding, wrong("--guest goes with --clock virtual or --check"));
    if (options_.steering_socket >= 0 && (options_.pace || options_.view))
      report(codes::kExcluding, wrong("--guest with two sockets excludes --pace and --view"));
  }

  // The default depends on the clock; a wrong clock says nothing about which executors fit.
  Status choose_executor() {
    const std::optional<std::string> name = call_.text("--executor");
    const bool is_virtual = options_.run.executive.clock == ClockKind::virtual_time;
    options_.chooses_executor = name.has_value();
    options_.run.executive.backend = name ? (*name == "thread"  ? Backend::thread
                                             : *name == "fiber" ? Backend::fiber
                                                                : Backend::baton)
                                          : (is_virtual ? Backend::fiber : Backend::thread);
    if (call_.is_wrong("--clock")) return ok();
    const Result<std::unique_ptr<Executive>> tried = make_executive(options_.run.executive);
    return tried ? ok() : Status(tried.error());
  }

  const apps::Call& call_;
  Options options_;
};

}  // namespace

Options parse_options(const std::vector<std::string>& words) {
  return Reader(apps::parse(program(), words)).read();
}

}  // namespace orca::deployer
