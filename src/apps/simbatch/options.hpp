// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/batch/batch.hpp"
#include "orca/batch/missing_runs.hpp"

namespace orca::simbatch {

/// The exit status of the program.
enum class ExitCode { done = 0, could_not_finish = 1, different = 1, bad_input = 2 };

/// The requests of a command line.
struct Options {
  enum class Action { run, check, table, report, diff, join, status, submit, pack, repeat, tune };
  Action action = Action::run;
  std::optional<std::string> answer{};  ///< What is to be printed, instead of any action.
  std::string subject;                  ///< The experiment, or the folder of results.
  std::vector<std::string> others;      ///< More folders of results.
  std::vector<std::string> plugins;     ///< Folders that the command line names, absolute.
  std::string out;                      ///< Folder for the results; empty: named after the experiment.
  bool resume = false;                  ///< Make what is missing in the folder.
  std::size_t shards = 16;              ///< Number of parts that a cluster gets.
  bool slurm = false;                   ///< The cluster is one of Slurm.
  batch::Shard shard;                   ///< Which part of the experiment to run.
  batch::BatchOptions batch;
};

/// Reads a command line.
/// @errors  invalid_argument with what was expected.
[[nodiscard]] Result<Options> parse_options(const std::vector<std::string>& words);

}  // namespace orca::simbatch
