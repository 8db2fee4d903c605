// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "processes.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <climits>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "companions.hpp"
#include "exit_code.hpp"
#include "orca/base/files/own_library.hpp"
#include "orca/base/log.hpp"
#include "orca/base/output_file.hpp"
#include "orca/base/text.hpp"
#include "orca/graph/loader.hpp"
#include "orca/graph/placement.hpp"
#include "orca/host/last_words.hpp"
#include "orca/supervisor/confinement_gaps.hpp"
#include "orca/supervisor/host_process_main.hpp"
#include "orca/supervisor/host_start.hpp"
#include "orca/supervisor/outputs.hpp"
#include "orca/supervisor/own_process.hpp"
#include "orca/supervisor/supervised_run.hpp"
#include "orca/supervisor/system_facts.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"
#include "progress.hpp"
#include "secured/key_needs.hpp"
#include "streams.hpp"

namespace orca::deployer {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kHostProcess = "--host-process";

fs::path own_program() { return fs::read_symlink("/proc/self/exe"); }

// Names files as host processes reach them: "/dev/stdout" is another one for them. They get the descriptors that are meant, as many as
// there is room for.
class ForChildren {
 public:
  host::RunOutputs outputs(const host::RunOutputs& outputs) {
    host::RunOutputs all = outputs;
    all.trace_file = file(all.trace_file);
    all.picture.file = file(all.picture.file);
    std::erase_if(all.recordings,
                  [](const host::RecordingOptions& one) { return host::is_bag_file(one.file); });
    for (host::RecordingOptions& recording : all.recordings) recording.file = file(recording.file);
    return all;
  }
  [[nodiscard]] const std::vector<int>& kept() const { return kept_; }

 private:
  std::string file(const std::string& name) {
    const std::optional<int> meant = descriptor_of(name);
    if (!meant || fcntl(*meant, F_GETFD) < 0 || kept_.size() == supervisor::kMostKept) return name;
    kept_.push_back(*meant);
    return "/proc/self/fd/" + std::to_string(supervisor::kFirstKept + kept_.size() - 1);
  }
  static std::optional<int> descriptor_of(const std::string& name) {
    if (name == "/dev/stdout") return STDOUT_FILENO;
    if (name == "/dev/stderr") return STDERR_FILENO;
    for (const std::string folder : {"/dev/fd/", "/proc/self/fd/"})
      if (name.starts_with(folder))
        if (const auto number = xml::parse_integer(name.substr(folder.size())); number && *number < INT_MAX)
          return static_cast<int>(*number);
    return std::nullopt;
  }

  std::vector<int> kept_;
};

// Opens a file as the host process will, and closes it as it was. A pipe would be closed for its reader, too.
Status try_to_open(OutputFile& file, const std::string& path) {
  return path.empty() || fs::is_fifo(path) ? ok() : file.open(path);
}

// Finds out before anything starts whether the outputs can be written and overwrite nothing: this process knows which
// files the graph is made of.
Status try_to_open(const host::RunOutputs& outputs) {
  OutputFile trace("the trace");
  OutputFile picture("the picture");
  std::deque<OutputFile> recordings;
  if (Status opened = try_to_open(trace, outputs.trace_file); !opened.ok()) return opened;
  if (Status opened = try_to_open(picture, outputs.picture.file); !opened.ok()) return opened;
  for (const host::RecordingOptions& recording : outputs.recordings) {
    if (host::is_bag_file(recording.file)) continue;  // its recorder opens it
    if (Status opened = try_to_open(recordings.emplace_back("the recording"), recording.file); !opened.ok())
      return opened;
  }
  return ok();
}

std::string without_last_newline(std::string text) {
  if (text.ends_with('\n')) text.pop_back();
  return text;
}

// Reads and checks a graph for a system that runs, with the profiles, settings and plugin folders of the command line.
Result<supervisor::CheckedSystem> read_system(const Options& options, const supervisor::GraphSource& source,
                                              const host::StopSignal& stop) {
  supervisor::CheckedSystem system;
  system.files.insert(source.file);
  const Result<std::string> text =
      source.text ? Result<std::string>(*source.text) : xml::read_bytes(source.file);
  if (!text) return fail(text.error().code, "the graph cannot be read: " + text.error().message, source.file);
  host::PluginCatalogue catalogue(plugin::PluginIndex(plugin_folders(options)));
  catalogue.give_up_if([&stop] { return stop.requested(); });
  xml::Diagnostics diagnostics;
  const auto read = [&system](const std::string& included) {
    system.files.insert(included);
    return xml::read_bytes(included);
  };
  graph::LoadOptions wishes{options.profiles, options.settings, options.strict};
  wishes.of_run = true;
  wishes.name = options.name;
  wishes.domain = options.domain;
  std::optional<graph::Graph> graph =
      graph::load_text(*text, source.file, wishes, catalogue, diagnostics, read);
  if (!graph) return fail(Code::invalid_argument, without_last_newline(diagnostics.text()));
  system.facts = supervisor::facts_of(*graph, catalogue);
  system.graph = *std::move(graph);
  return system;
}

// Returns the files that the graph is made of, the main one first.
std::vector<std::string> files_of(const Options& options, const host::StopSignal& stop) {
  std::vector<std::string> files{options.file};
  const Result<supervisor::CheckedSystem> system = read_system(options, {options.file}, stop);
  if (!system) return files;  // it was changed just now
  for (const std::string& file : system->files)
    if (file != options.file) files.push_back(file);
  return files;
}

host::RunResult refuse(const Error& error, const std::string& log_name, host::RunListener& listener) {
  log::error(log_name, error.text());
  host::RunResult result;
  const bool wrong = error.code == Code::invalid_argument || error.code == Code::already_exists;
  result.outcome = wrong ? host::RunOutcome::bad_options : host::RunOutcome::not_started;
  result.error = error;
  listener.ended(result);
  return result;
}

}  // namespace

std::vector<std::string> plugin_folders(const Options& options) {
  std::vector<std::string> folders{own_plugin_folder()};
  folders.insert(folders.end(), options.plugin_folders.begin(), options.plugin_folders.end());
  return folders;
}

bool has_host_processes(const Options& options) {
  return options.run.executive.clock == ClockKind::steady && !options.in_process;
}

Result<std::string> machine_of_run(const graph::Graph& graph, const Options& options) {
  const auto refuse = [](const std::string& text) { return fail(Code::invalid_argument, text); };
  std::vector<std::string> names;
  for (const graph::MachineNode& node : graph.machines)
    if (!graph::processes_on(graph, node.name).empty()) names.push_back(node.name);
  const std::string choice = "--machine NAME, one of: " + listed(names);
  if (graph.machines.empty() && !options.machine.empty())
    return refuse("--machine: the graph declares no machines");
  if (options.machine.empty() && names.size() > 1)
    return refuse("the graph runs on several machines; say which one this is: " + choice);
  if (options.machine.empty()) return names.empty() ? "" : names.front();
  if (std::ranges::find(names, options.machine) == names.end())
    return refuse("nothing of the graph runs on a machine " + in_quotes(options.machine) + "; write " +
                  choice + xml::did_you_mean(xml::nearest_name(options.machine, names)));
  return options.machine;
}

Status check_for_processes(const graph::Graph& graph, const Options& options) {
  const bool is_baton = options.run.executive.backend == Backend::baton;
  if (is_baton && graph::processes_of(graph).size() > 1)
    return fail(Code::invalid_argument,
                "--executor baton runs one strand at a time, which several processes cannot do together; add "
                "--in-process");
  return supervisor::check_outputs(graph, options.run);
}

host::RunResult run_in_processes(const graph::Graph& graph, const std::string& machine,
                                 const Options& options, host::PluginCatalogue& catalogue,
                                 host::StopSignal& stop, host::RunListener& listener) {
  supervisor::SupervisedOptions supervised;
  supervised.facts = supervisor::facts_of(graph, catalogue);
  supervised.program = own_program().string();
  supervised.arguments = {"deployer", std::string(kHostProcess)};
  const std::vector<std::string> folders = plugin_folders(options);
  supervised.arguments.insert(supervised.arguments.end(), folders.begin(), folders.end());
  supervised.machine = machine;
  supervised.read = [&options, &stop](const supervisor::GraphSource& source) {
    return read_system(options, source, stop);
  };
  supervised.graph_file = fs::absolute(options.file).lexically_normal().string();
  supervised.watches = options.watch;
  supervised.holds = options.hold;
  supervised.grants = options.grants;
  if (options.watch) supervised.graph_files = files_of(options, stop);
  supervised.seed = options.run.seed;
  supervised.until = options.run.until;
  supervised.planned_failures = options.run.planned_failures;
  if (options.chooses_executor) supervised.executor = options.run.executive.backend;
  supervised.log_level = options.log_level;
  supervised.log_name = options.run.log_name;
  ForChildren for_children;
  supervised.outputs = for_children.outputs(options.run);
  supervised.kept_descriptors = for_children.kept();
  for (const std::string& folder : options.writable)
    supervised.writable.push_back(fs::absolute(folder).lexically_normal().string());
  supervised.outputs.looks_on = options.progress.value_or(stderr_can_live());
  if (const Status opened = try_to_open(options.run); !opened.ok())
    return refuse(opened.error(), options.run.log_name, listener);
  if (const Status there = check_keys(graph, machine); !there.ok())
    return refuse(there.error(), options.run.log_name, listener);
  const std::optional<apps::ChildProgram> viewer = options.view ? start_viewer(graph.name) : std::nullopt;
  if (const std::string gaps = supervisor::confinement_gaps(); !gaps.empty())
    log::info(options.run.log_name, "this kernel does not keep host processes from: " + gaps);
  Recorders recorders;
  if (const Status started = recorders.start(graph, machine, options.run.recordings); !started.ok())
    return refuse(started.error(), options.run.log_name, listener);
  supervised.recorders = recorders.count();
  supervised.look_beside = [&recorders](bool has_come_up) {
    if (has_come_up) notify_service("READY=1\nWATCHDOG=1");
    return recorders.look();
  };
  host::RunResult result = supervisor::run_supervised(graph, supervised, stop, listener);
  if (const Status recorded = recorders.finish(); !recorded.ok()) {
    log::error(options.run.log_name, recorded.error().text());
    if (exit_code_of(result.outcome) == ExitCode::finished) result.outcome = host::RunOutcome::failed;
  }
  return result;
}

bool is_host_process(int argc, char** argv) { return argc > 1 && argv[1] == kHostProcess; }

int be_host_process(int argc, char** argv) {
  Result<Descriptor> channel = supervisor::take_channel();
  if (!channel) {
    std::fprintf(stderr, "error: %s is for the deployer itself: %s\n", argv[1],
                 channel.error().text().c_str());
    return static_cast<int>(ExitCode::bad_input);
  }
  const host::LastWords last_words(static_cast<int>(ExitCode::failed_running),
                                   static_cast<int>(ExitCode::could_not_start));
  return supervisor::host_process_main(std::move(channel).value(), {argv + 2, argv + argc});
}

}  // namespace orca::deployer
