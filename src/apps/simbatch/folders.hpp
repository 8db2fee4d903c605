// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "options.hpp"
#include "orca/batch/experiment.hpp"
#include "orca/batch/store.hpp"

namespace orca::simbatch {

/// Returns the file of the results in a folder. A path that is a file is that file.
[[nodiscard]] std::filesystem::path results_in(const std::filesystem::path& folder);

/// Returns the names of the files and folders that a report consists of, in the folder of its results.
[[nodiscard]] std::vector<std::string> names_of_report();

/// Checks that nothing of somebody else lies where results are to be written for the first time.
/// @param names  of files and folders that will be written, and replaced, there.
/// @errors  already_exists, with the first that is there in a folder without results.
[[nodiscard]] Status check_free(const std::filesystem::path& folder, const std::vector<std::string>& names);

/// Returns the error that a folder has no file of results.
[[nodiscard]] Error no_results(const std::string& folder);

/// Opens results that are there, whatever experiment they are of.
/// @errors  not_found if there are none; those of Store::open().
[[nodiscard]] Result<std::unique_ptr<batch::Store>> open_results(const std::string& folder);

/// Returns the experiment that results are of, if its file is still as it was.
[[nodiscard]] std::optional<batch::Experiment> experiment_of(const batch::Store& store);

/// Returns the options for runs that look for plugins in Orca's own folder and then in these.
[[nodiscard]] batch::BatchOptions with_plugins(batch::BatchOptions options,
                                               const std::vector<std::string>& folders);

/// Returns what this program was built of: "orca 0.1.0, GNU 12.2.0, Release; commit 2e36618e1c3a".
[[nodiscard]] std::string build_text();

/// Says an error on stderr.
ExitCode refuse(const Error& error);

}  // namespace orca::simbatch
