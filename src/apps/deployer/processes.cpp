// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "processes.hpp"

#include <cstdio>
#include <filesystem>
#include <string_view>
#include <utility>

#include "exit_code.hpp"
#include "orca/base/text.hpp"
#include "orca/host/last_words.hpp"
#include "orca/supervisor/host_process_main.hpp"
#include "orca/supervisor/own_process.hpp"
#include "orca/supervisor/supervised_run.hpp"
#include "progress.hpp"
#include "streams.hpp"

namespace orca::deployer {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kHostProcess = "--host-process";

fs::path own_program() { return fs::read_symlink("/proc/self/exe"); }

}  // namespace

std::vector<std::string> plugin_folders(const Options& options) {
  std::vector<std::string> folders{(own_program().parent_path().parent_path() / "plugins").string()};
  folders.insert(folders.end(), options.plugin_folders.begin(), options.plugin_folders.end());
  return folders;
}

bool has_host_processes(const graph::Graph& graph, const Options& options) {
  return options.run.executive.clock == ClockKind::steady && !options.in_process && !graph.processes.empty();
}

Status check_for_processes(const graph::Graph& graph, const Options& options) {
  if (graph.machines.size() > 1)
    return fail(Code::invalid_argument,
                "several machines cannot be run in real time yet; leave one in the graph", options.file);
  if (graph.supervision.on_supervisor_loss == graph::OnLoss::go_on)
    return fail(
        Code::invalid_argument,
        "on_supervisor_loss=\"continue\" is not available yet; take it out, and the processes stop the robot "
        "and end when the deployer is gone",
        options.file);
  std::vector<std::string> unfit;
  if (!options.run.trace_file.empty()) unfit.emplace_back("--trace");
  if (!options.run.recordings.empty()) unfit.emplace_back("--record");
  if (!options.run.picture.file.empty()) unfit.emplace_back("--picture");
  if (options.stats) unfit.emplace_back("--stats");
  if (unfit.empty()) return ok();
  return fail(Code::invalid_argument,
              listed(unfit) + (unfit.size() == 1 ? " needs" : " need") +
                  " all parts of the system in one process, and the graph has several; add "
                  "--in-process or --clock virtual");
}

host::RunResult run_in_processes(const graph::Graph& graph, const Options& options, host::StopSignal& stop,
                                 host::RunListener& listener) {
  supervisor::SupervisedOptions supervised;
  supervised.program = own_program().string();
  supervised.arguments = {"deployer", std::string(kHostProcess)};
  const std::vector<std::string> folders = plugin_folders(options);
  supervised.arguments.insert(supervised.arguments.end(), folders.begin(), folders.end());
  supervised.seed = options.run.seed;
  supervised.until = options.run.until;
  supervised.planned_failures = options.run.planned_failures;
  supervised.log_level = options.log_level;
  supervised.looks_on = options.progress.value_or(stderr_can_live());
  return supervisor::run_supervised(graph, supervised, stop, listener);
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
