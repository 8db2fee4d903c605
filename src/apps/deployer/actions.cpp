// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "actions.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "codes.hpp"
#include "companions.hpp"
#include "console.hpp"
#include "describe.hpp"
#include "guest/guest_types.hpp"
#include "guest/steering.hpp"
#include "laps.hpp"
#include "objects/describe_object.hpp"
#include "orca/base/log.hpp"
#include "orca/base/output_file.hpp"
#include "orca/base/system/pace.hpp"
#include "orca/base/text.hpp"
#include "orca/graph/diff.hpp"
#include "orca/graph/loader.hpp"
#include "orca/graph/plan.hpp"
#include "orca/graph/port_list.hpp"
#include "orca/graph/print.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/plugin/object_library.hpp"
#include "orca/supervisor/attendance.hpp"
#include "orca/supervisor/system_facts.hpp"
#include "processes.hpp"
#include "progress.hpp"
#include "secured/key_needs.hpp"
#include "streams.hpp"
#include "types.hpp"

namespace orca::deployer {
namespace {

using Action = Options::Action;

ExitCode show(const std::string& text) {
  write_out(text);
  return ExitCode::finished;
}

plugin::PluginIndex index_of(const Options& options) { return plugin::PluginIndex(plugin_folders(options)); }

// Types of the program that has started this one, if it has any. They outlive all components.
std::unique_ptr<guest::GuestTypes> g_guests;

// A graph, and the catalogue that has checked it.
struct Loaded {
  explicit Loaded(const Options& options) : catalogue(index_of(options), options.run.executive.clock) {
    if (g_guests) g_guests->add_to(catalogue);
  }

  xml::Diagnostics diagnostics;
  host::PluginCatalogue catalogue;
  std::optional<graph::Graph> graph;
  std::vector<graph::PlannedChange> changes;  // that the graph names, even if it is wrong
};

// Returns whether messages go to stdout, all together.
bool shows_json_faults(const Options& options) { return options.json && options.action == Action::check; }

void load(const std::string& file, const Options& options, Loaded& loaded) {
  const bool judges = options.action == Action::check || options.action == Action::run;
  graph::LoadOptions wanted{options.profiles, options.settings, options.strict, judges};
  wanted.of_run = options.action == Action::diff;
  wanted.changes = &loaded.changes;
  wanted.name = options.name;
  wanted.domain = options.domain;
  wanted.any_link = !judges || options.run.executive.clock == ClockKind::virtual_time;
  if (judges) {
    for (const host::PlannedFailure& planned : options.run.planned_failures)
      wanted.failing.push_back(planned.component);
    for (const host::RecordingOptions& recording : options.run.recordings)
      wanted.recorded.insert(wanted.recorded.end(), recording.ports.begin(), recording.ports.end());
  }
  loaded.graph = graph::load_file(file, wanted, loaded.catalogue, loaded.diagnostics);
  if (!shows_json_faults(options)) std::fputs(loaded.diagnostics.text().c_str(), stderr);
}

// Returns the object types that a word names: one, or those of a library; none if it names something else.
Result<std::vector<const ObjectType*>> object_types_of(const std::string& word,
                                                       const plugin::PluginIndex& index) {
  std::vector<const ObjectType*> types;
  const auto place = index.object_types().find(word);
  const std::string file = place != index.object_types().end() ? place->second.library : word;
  const plugin::PluginIndex beside({std::filesystem::absolute(file).parent_path().string()});
  const bool is_library =
      names_plugin_file(file) && std::ranges::any_of(beside.object_libraries(), [&](const std::string& one) {
        return std::filesystem::path(one).filename() == std::filesystem::path(file).filename();
      });
  if (is_library)
    if (const Status loaded = plugin::load_object_library(file); !loaded.ok()) return loaded.error();
  if (const ObjectType* const type = find_object_type(word)) types.push_back(type);
  if (is_library && types.empty())
    for (const auto& [type, listed] : beside.object_types())
      if (std::filesystem::path(listed.library).filename() == std::filesystem::path(file).filename())
        types.push_back(find_object_type(type));
  return types;
}

std::string library_of(const ObjectType& type) {
  for (const plugin::ObjectLibrary& library : plugin::object_libraries())
    if (std::ranges::find(library.types, type.name) != library.types.end()) return library.file;
  return {};
}

Result<PluginDescription> description_of(const Options& options, const plugin::PluginIndex& index) {
  if (names_plugin_file(options.file)) return describe_plugin(options.file);
  const Result<std::string> file = index.file_of(options.file);
  if (file) return describe_plugin(*file, options.file);
  return fail(file.error().code, file.error().message + hint_at_type(options.file, index));
}

ExitCode describe(const Options& options) {
  const plugin::PluginIndex index = index_of(options);
  const Result<std::vector<const ObjectType*>> objects = object_types_of(options.file, index);
  if (objects && !objects->empty()) {
    const std::string library = library_of(*objects->front());
    return show(options.json ? objects_json(*objects, library) : objects_text(*objects, library));
  }
  const Result<PluginDescription> plugin = objects ? description_of(options, index) : objects.error();
  if (plugin) return show(options.json ? json(*plugin) : text(*plugin));
  std::fprintf(stderr, "error: %s\n", plugin.error().text().c_str());
  return ExitCode::bad_input;
}

// Writes the graph's language with the types that are installed. A plugin that cannot be loaded is reported once and left out.
ExitCode write_schema(const Options& options) {
  const plugin::PluginIndex index = index_of(options);
  std::vector<Contract> types;
  std::set<std::string> faults;
  for (const PluginKind kind : {PluginKind::component, PluginKind::hardware}) {
    for (const std::string& type : index.types(kind)) {
      const Result<std::string> file = index.file_of(type);
      Result<PluginDescription> plugin = file ? describe_plugin(*file, type) : file.error();
      if (plugin)
        types.push_back(std::move(plugin->types.front()));
      else
        faults.insert(plugin.error().text());
    }
  }
  for (const std::string& fault : faults) std::fprintf(stderr, "error: %s\n", fault.c_str());
  show(graph::schema(
      types, options.action == Options::Action::rnc ? xml::SchemaLanguage::rnc : xml::SchemaLanguage::xsd));
  return faults.empty() ? ExitCode::finished : ExitCode::bad_input;
}

// Returns 0 if both describe the same system, 1 if they do not, 2 if one of them describes none.
ExitCode compare(const Options& options) {
  Loaded before(options);
  Loaded after(options);
  load(options.file, options, before);
  load(options.other_file, options, after);
  if (!before.graph || !after.graph) return ExitCode::bad_input;
  const std::vector<graph::Change> changes = graph::diff(*before.graph, *after.graph);
  show(options.json ? graph::diff_json(changes) : graph::diff_text(changes));
  return changes.empty() ? ExitCode::finished : ExitCode::failed_running;
}

std::string names_of_profiles(const Options& options, const graph::Graph& graph) {
  std::string names;
  for (const std::string& name : options.profiles) names += (names.empty() ? "" : ", ") + name;
  return options.profiles.empty() ? graph.default_profile : names;
}

ExitCode show_graph(const Options& options) {
  Loaded loaded(options);
  load(options.file, options, loaded);
  if (!loaded.graph) return ExitCode::bad_input;
  const graph::Graph& graph = *loaded.graph;
  if (options.action == Action::dot) return show(graph::dot(graph, names_of_profiles(options, graph)));
  if (options.action == Action::mermaid)
    return show(graph::mermaid(graph, names_of_profiles(options, graph)));
  if (options.action == Action::print)
    return show(options.json ? graph::graph_json(graph) : graph::print(graph));
  const std::vector<graph::ListedPort> ports = graph::list_ports(graph, loaded.catalogue);
  return show(options.json ? graph::ports_json(ports) : graph::ports_text(ports));
}

ExitCode refuse_option(const char* code, const Error& error) {
  xml::Diagnostics diagnostics;
  diagnostics.error(code, {error.where.empty() ? "command line" : error.where, 0, 0}, error.message);
  std::fputs(diagnostics.text().c_str(), stderr);
  return ExitCode::bad_input;
}

// Returns what is wrong if a run cannot go over to another graph.
xml::Diagnostics faults_of(const graph::PlannedChange& change, const std::string& obstacles) {
  xml::Diagnostics faults;
  if (change.position.file.empty())
    faults.error(codes::kOptionValue, {"command line", 0, 0}, "--change " + change.file + ": " + obstacles);
  else
    faults.error(codes::kChange, change.position, "<change> to " + in_quotes(change.file) + ": " + obstacles);
  return faults;
}

void append(const xml::Diagnostics& more, xml::Diagnostics& all) {
  for (const xml::Diagnostic& one : more.sorted())
    one.severity == xml::Severity::error ? all.error(one.code, one.position, one.message)
                                         : all.warning(one.code, one.position, one.message);
}

// Reads the graphs that a run goes over to, and plans how. Those of the graph come before those of the command line if their
// times are the same.
// @param said  gets all messages about them, which --check --json shows together.
// @return nothing if that is not possible, after it was said.
std::optional<std::vector<host::TimedChange>> plan_changes(const Options& options, const Loaded& first,
                                                           xml::Diagnostics& said) {
  std::vector<graph::PlannedChange> planned = first.changes;
  planned.insert(planned.end(), options.changes.begin(), options.changes.end());
  if (planned.empty() && first.graph) return std::vector<host::TimedChange>{};
  std::ranges::stable_sort(planned, {}, &graph::PlannedChange::at);
  std::vector<host::TimedChange> changes;
  std::optional<graph::Graph> before = first.graph;  // nothing if one of the graphs so far is wrong
  std::set<std::string> wrong;                       // files of which it was said
  for (const graph::PlannedChange& one : planned) {
    if (wrong.contains(one.file)) continue;
    Loaded after(options);
    load(one.file, options, after);
    append(after.diagnostics, said);
    if (!after.graph) before.reset(), wrong.insert(one.file);
    if (!before) continue;  // the others have their own faults
    const supervisor::SystemFacts facts = supervisor::facts_of(*after.graph, after.catalogue);
    host::TimedChange change{
        one.file, one.at, graph::plan_of(*before, *after.graph, facts.contracts, {}), {}};
    if (!change.plan.is_possible()) {
      const xml::Diagnostics faults = faults_of(one, graph::obstacles_of(change.plan));
      append(faults, said);
      if (!shows_json_faults(options)) std::fputs(faults.text().c_str(), stderr);
      before.reset();
      continue;
    }
    for (const auto& [type, plugin] : facts.plugins) change.plugins[type] = plugin.file;
    changes.push_back(std::move(change));
    before = std::move(after.graph);
  }
  return before ? std::optional(std::move(changes)) : std::nullopt;
}

ExitCode check(const Options& options) {
  Loaded loaded(options);
  load(options.file, options, loaded);
  const bool is_good = plan_changes(options, loaded, loaded.diagnostics).has_value();
  if (options.json) show(loaded.diagnostics.json());
  if (!is_good) return ExitCode::bad_input;
  if (!options.json) {
    std::fprintf(stderr, "%s: no errors; %zu components, %zu connections\n", options.file.c_str(),
                 loaded.graph->components.size(), loaded.graph->edges.size());
    std::fputs(key_needs(*loaded.graph).c_str(), stderr);
  }
  return ExitCode::finished;
}

// Runs everything in this process.
ExitCode run_here(Loaded& loaded, const Options& options, const host::RunOptions& run, host::StopSignal& stop,
                  host::RunListener& listener) {
  OutputFile laps("the time of laps");
  if (run.measures_laps)
    if (const Status opened = laps.open(options.laps_file); !opened.ok())
      return refuse_option(codes::kOptionValue, opened.error());
  const host::RunResult result = host::run_system(*loaded.graph, loaded.catalogue, run, stop, listener);
  const Status written = run.measures_laps ? write_laps(laps, *loaded.graph, result) : ok();
  if (!written.ok()) log::error("deployer", written.error().text());
  return written.ok() ? exit_code_of(result.outcome) : ExitCode::failed_running;
}

// Runs everything in this process, in virtual time, for people who look on and command it.
ExitCode run_attended(Loaded& loaded, const Options& options, host::RunOptions run, host::StopSignal& stop,
                      Console& console) {
  if (!run.changes.empty())
    return refuse_option(codes::kExcluding,
                         fail(Code::invalid_argument,
                              "a change at a given time (--change, <change>) excludes --view and --pace"));
  constexpr double kAsTheClock = 1.0;
  Pace pace(options.pace.value_or(kAsTheClock));
  const auto attendance = supervisor::Attendance::open(
      {*loaded.graph, supervisor::facts_of(*loaded.graph, loaded.catalogue), run.log_name}, pace, console);
  if (!attendance) {
    log::error(run.log_name, attendance.error().text());
    return ExitCode::could_not_start;
  }
  run.visitors = attendance->get();
  const std::optional<apps::ChildProgram> viewer =
      options.view ? start_viewer(loaded.graph->name) : std::nullopt;
  return run_here(loaded, options, run, stop, **attendance);
}

// Returns what is wrong with an option that is for host processes, where there are none; "" if there is no such option.
std::string fault_without_processes(const Options& options) {
  if (!options.writable.empty())
    return "--writable: only host processes are kept from other folders; leave it out";
  const std::string option = options.hold ? "--hold" : options.grants.empty() ? "" : "--allow";
  if (option.empty()) return "";
  return option + ": orcactl reaches host processes only; leave out --in-process and --clock virtual";
}

// Runs everything in this process, in steps of virtual time that a program asks for.
ExitCode run_steered(Loaded& loaded, const Options& options, host::RunOptions run, host::StopSignal& stop,
                     Console& console) {
  if (!run.changes.empty())
    return refuse_option(
        codes::kExcluding,
        fail(Code::invalid_argument, "a change at a given time (--change, <change>) excludes steps"));
  std::vector<graph::PortRef> ports;
  for (const graph::ListedPort& port : graph::list_ports(*loaded.graph, loaded.catalogue))
    if (host::is_source(port.contract) && !port.disabled) ports.push_back(port.ref);
  guest::Steering steering(Descriptor(options.steering_socket), std::move(ports));
  run.visitors = &steering;
  return run_here(loaded, options, run, stop, console);
}

std::vector<Console::Planned> planned_by(const Options& options) {
  std::vector<Console::Planned> planned;
  for (const host::PlannedFailure& one : options.run.planned_failures)
    planned.push_back({"the failure of " + one.component, one.at});
  for (const graph::PlannedChange& one : options.changes)
    planned.push_back({"the change to " + one.file, one.at});
  return planned;
}

ExitCode run(const Options& options) {
  // First of all, so that a signal at any moment ends the run properly, and never destroyed, so that it also does
  // while the last destructors and atexit handlers run.
  static auto& stop =
      *new host::StopSignal(static_cast<int>(ExitCode::finished), static_cast<int>(ExitCode::failed_running));
  Loaded loaded(options);
  loaded.catalogue.give_up_if([] { return stop.requested(); });
  load(options.file, options, loaded);
  host::RunOptions run = options.run;
  std::optional<std::vector<host::TimedChange>> changes = plan_changes(options, loaded, loaded.diagnostics);
  if (!changes) return ExitCode::bad_input;
  run.changes = *std::move(changes);
  run.looks_on = options.progress.value_or(stderr_can_live());
  Console console(options.stats, run.looks_on);
  console.expect(planned_by(options));
  if (has_host_processes(options)) {
    if (!run.changes.empty())
      return refuse_option(codes::kExcluding,
                           fail(Code::invalid_argument,
                                "a change at a given time (--change, <change>) needs --clock virtual or "
                                "--in-process; host processes are changed with orcactl apply"));
    if (run.measures_laps)
      return refuse_option(codes::kExcluding, fail(Code::invalid_argument,
                                                   "--measure-laps needs --clock virtual or --in-process"));
    if (const Status fits = check_for_processes(*loaded.graph, options); !fits.ok())
      return refuse_option(codes::kExcluding, fits.error());
    const Result<std::string> machine = machine_of_run(*loaded.graph, options);
    if (!machine) return refuse_option(codes::kOptionValue, machine.error());
    return exit_code_of(
        run_in_processes(*loaded.graph, *machine, options, loaded.catalogue, stop, console).outcome);
  }
  if (options.watch)
    return refuse_option(
        codes::kExcluding,
        fail(
            Code::invalid_argument,
            "--watch: code is exchanged in host processes only; leave out --in-process and --clock virtual"));
  const bool is_virtual = run.executive.clock == ClockKind::virtual_time;
  if (options.view && !is_virtual)
    return refuse_option(codes::kExcluding,
                         fail(Code::invalid_argument,
                              "--view: in real time the page reaches host processes only; leave out "
                              "--in-process"));
  if (const std::string fault = fault_without_processes(options); !fault.empty())
    return refuse_option(codes::kExcluding, fail(Code::invalid_argument, fault));
  if (!options.machine.empty())
    return refuse_option(codes::kExcluding, fail(Code::invalid_argument,
                                                 "--machine: here everything runs in this process; leave it "
                                                 "out"));
  if (options.view || options.pace) return run_attended(loaded, options, std::move(run), stop, console);
  if (options.steering_socket >= 0) return run_steered(loaded, options, std::move(run), stop, console);
  return run_here(loaded, options, run, stop, console);
}

bool reads_one_graph(Action action) {
  return action == Action::run || action == Action::check || action == Action::print ||
         action == Action::dot || action == Action::mermaid || action == Action::list_ports;
}

// Reports what is wrong with the command line, and with the graph that it names.
ExitCode refuse(const Options& options) {
  Loaded loaded(options);
  loaded.diagnostics = options.problems;
  if (reads_one_graph(options.action) && !options.file.empty()) {
    load(options.file, options, loaded);
  } else {
    std::fputs(loaded.diagnostics.text().c_str(), stderr);
  }
  if (options.json && options.action == Action::check) show(loaded.diagnostics.json());
  return ExitCode::bad_input;
}

}  // namespace

ExitCode act(const Options& options) {
  if (options.problems.has_errors()) return refuse(options);
  if (options.answer) return show(*options.answer);
  if (options.guest_socket >= 0) {
    plugin::load_object_libraries(index_of(options));  // components of another program may use their types
    Result<std::unique_ptr<guest::GuestTypes>> guests =
        guest::GuestTypes::receive(Descriptor(options.guest_socket));
    if (!guests) return refuse_option(codes::kOptionValue, guests.error());
    g_guests = std::move(guests).value();
  }
  switch (options.action) {
    case Action::schema:
    case Action::rnc: return write_schema(options);
    case Action::describe: return describe(options);
    case Action::types:
      return show(options.json ? types_json(index_of(options)) : types_text(index_of(options)));
    case Action::check: return check(options);
    case Action::diff: return compare(options);
    case Action::run: return run(options);
    default: return show_graph(options);
  }
}

}  // namespace orca::deployer
