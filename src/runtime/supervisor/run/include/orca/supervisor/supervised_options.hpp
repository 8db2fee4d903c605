// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/executive.hpp"
#include "orca/base/log.hpp"
#include "orca/base/time.hpp"
#include "orca/host/planned_failure.hpp"
#include "orca/host/run_outputs.hpp"
#include "orca/supervisor/access.hpp"
#include "orca/supervisor/log_name.hpp"
#include "orca/supervisor/system_facts.hpp"

namespace orca::supervisor {

/// The options of a run in host processes.
struct SupervisedOptions {
  std::string program;                 ///< Path of the program of a host process.
  std::vector<std::string> arguments;  ///< What its main() gets, from argv[0] on.
  std::string machine;                 ///< The one of the graph that this is; empty: it declares none.
  std::optional<std::uint64_t> seed;   ///< None: the graph's seed, or 1 if it has none.
  std::optional<Duration> until;    ///< Time limit [s], counted from when everything is up; none: no limit.
  std::optional<Backend> executor;  ///< Of all processes; none: as the graph says.
  std::vector<host::PlannedFailure> planned_failures;
  log::Level log_level = log::Level::info;
  std::string log_name = kLogName;    ///< Name in the log for what concerns the run as a whole.
  std::vector<std::string> writable;  ///< Folders in which components may write, besides those of HostStart.
  std::vector<int> kept_descriptors;  ///< Of this process, which host processes get: HostStart::kept.
  host::RunOutputs outputs;  ///< Checked by check_outputs(). A process that is started again writes none.
  SystemFacts facts;         ///< For operators.
  SystemReader read;         ///< Reads graphs that are to be carried out; empty: none are.
  std::string graph_file;    ///< The main one that the graph was read from, absolute.
  std::vector<std::string>
      graph_files;  ///< That are watched: all that the graph was read from, the main one first.
  /// Code of components that is built anew takes the place of the old one, and a graph that is saved is carried out.
  bool watches = false;
  std::size_t recorders =
      0;  ///< Programs with bounded lines without which nothing begins to work, for a moment at least.
  /// Returns what is wrong with programs beside the system, by what they serve, such as a recording. It is called every
  /// second while the system runs, and hears whether all has come up; what it no longer names is right again. Empty: there are no
  /// such programs.
  std::function<std::map<std::string, std::string>(bool has_come_up)> look_beside;
  std::vector<Grant> grants;  ///< What other users may do; none: nobody else can ask anything.
  bool holds = false;         ///< What moves is held from the start, until an operator releases it.
};

}  // namespace orca::supervisor
