// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/batch/experiment.hpp"
#include "orca/batch/store.hpp"

namespace orca::batch {

/// The pages of a report on a batch, the same for the same results.
struct Report {
  std::string html;      ///< Self-contained, with plots.
  std::string markdown;  ///< The same without plots.
  std::map<std::string, std::string>
      files;            ///< Drawings and tables for a paper: path from the pages' folder on, and content.
  std::string summary;  ///< The findings, established or not, a line each, for a terminal.
};

/// Returns what an experiment declares: its metrics, contrasts, seeds and worlds.
[[nodiscard]] std::vector<Declaration> declarations_of(const Experiment& experiment, const std::string& date);

/// Makes the report on those results of an experiment that there are.
/// @errors  those of the store; failed_precondition if it holds no run of the experiment.
/// @thread  one thread, which may use the store.
[[nodiscard]] Result<Report> make_report(const Experiment& experiment, const Store& store);

/// The Declaration::what of the builds that made runs. Its text is for people.
inline constexpr const char* kBuildDeclaration = "build";

/// Returns where results come from, as one JSON value: builds with the date of the first run of each, hashes of programs, plugins
/// and files, seeds, realism, the parameters in which variants differ, settings of worlds, and the experiment's text. Paths start
/// at the experiment's folder.
[[nodiscard]] std::string provenance_json(const Experiment& experiment, const Store& store);

/// Returns the command that makes one run again, alone, for a shell in the experiment's folder.
[[nodiscard]] std::string replay_command(const Experiment& experiment, const Run& run);
/// Returns the command that makes it in real time, to look on in a browser. It differs from the run as runs in real time do; and laps take
/// the time that they take.
[[nodiscard]] std::string watch_command(const Experiment& experiment, const Run& run);

}  // namespace orca::batch
