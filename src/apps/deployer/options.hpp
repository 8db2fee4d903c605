// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "orca/base/log.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/run_system.hpp"
#include "orca/supervisor/access.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::deployer {

/// The requests of a command line.
struct Options {
  enum class Action { run, check, print, dot, mermaid, list_ports, diff, describe, types, schema, rnc };
  Action action = Action::run;
  std::optional<std::string> answer{};      ///< What is to be printed, instead of any action.
  std::string file;                         ///< The graph, or the plugin or type to describe.
  std::string other_file;                   ///< The graph to compare it with.
  bool strict = false;                      ///< Warnings are errors.
  bool json = false;                        ///< Output for programs.
  bool stats = false;                       ///< Write what the connections of a run carried.
  bool watch = false;                       ///< Code that is built anew takes the place of the old one.
  std::vector<supervisor::Grant> grants{};  ///< What other users may do.
  std::vector<std::string> writable{};      ///< Folders in which host processes may write, too.
  bool hold = false;                        ///< Nothing moves before an operator releases it.
  bool view = false;                        ///< orcaview is started beside the system.
  std::optional<double> pace;               ///< Of virtual time, see Pace; nothing: not given.
  bool in_process = false;                  ///< No host processes, whatever the graph says.
  bool chooses_executor = false;            ///< --executor was given.
  int guest_socket = -1;                    ///< To a program with component types; -1: there is none.
  int steering_socket = -1;                 ///< To a program that steps the run; -1: there is none.
  std::string laps_file;                    ///< Where the time of laps is written; empty: nowhere.
  std::string machine;                      ///< The one of the graph that this is; empty: not given.
  std::string name;                         ///< Of the system; empty: the graph's.
  std::optional<std::uint32_t> domain;      ///< Of DDS; nothing: the graph's.
  std::optional<bool> progress;             ///< Show how a run is going; nothing: if stderr is a terminal.
  std::vector<std::string> plugin_folders;  ///< Searched after Orca's own.
  std::vector<std::string> profiles;
  std::vector<std::string> settings;          ///< From --set: ARG=VALUE or COMPONENT.PARAM=VALUE.
  std::vector<graph::PlannedChange> changes;  ///< Beside those of the graph.
  xml::Diagnostics problems;                  ///< What is wrong with the command line itself (codes Cxxx).
  host::RunOptions run;                       ///< Without its changes, which are to be read.
  log::Level log_level = log::Level::info;
};

/// Reads a command line. What is wrong with it is in the result's `problems`, all of it at once.
[[nodiscard]] Options parse_options(const std::vector<std::string>& words);

/// Returns the table of what the deployer's command line may hold.
[[nodiscard]] const apps::Program& program();

}  // namespace orca::deployer
