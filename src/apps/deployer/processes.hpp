// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>
#include <vector>

#include "options.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/host/run_listener.hpp"
#include "orca/host/run_result.hpp"
#include "orca/host/stop_signal.hpp"

namespace orca::deployer {

/// Returns the folders that are searched for plugins: that of Orca's own, beside the program, and those of the command
/// line. The graph may name more; no environment variable does.
[[nodiscard]] std::vector<std::string> plugin_folders(const Options& options);

/// Returns whether the run has host processes below this one: in real time, unless they are not wanted.
[[nodiscard]] bool has_host_processes(const Options& options);

/// Returns the machine of the graph that this is; empty: the graph declares none.
/// @errors  invalid_argument if the options name none although the graph has several, or one that it does not have.
[[nodiscard]] Result<std::string> machine_of_run(const graph::Graph& graph, const Options& options);

/// Checks that graph and options fit a run in host processes.
/// @errors  invalid_argument with the option that needs all parts in one process, or with what the graph asks for that
///          does not exist yet.
[[nodiscard]] Status check_for_processes(const graph::Graph& graph, const Options& options);

/// Runs a graph in host processes, or what of it runs on one machine. This process only supervises them.
/// @param machine    of the graph; empty: it declares none.
/// @param catalogue  the one that has checked the graph.
/// @thread  the main thread.
[[nodiscard]] host::RunResult run_in_processes(const graph::Graph& graph, const std::string& machine,
                                               const Options& options, host::PluginCatalogue& catalogue,
                                               host::StopSignal& stop, host::RunListener& listener);

/// Returns whether this process was started by another deployer as a host process.
[[nodiscard]] bool is_host_process(int argc, char** argv);

/// Lives the life of a host process.
/// @return the program's exit status.
/// @thread  the main thread, before anything else.
[[nodiscard]] int be_host_process(int argc, char** argv);

}  // namespace orca::deployer
