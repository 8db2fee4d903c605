// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "options.hpp"
#include "orca/batch/experiment.hpp"
#include "orca/batch/store.hpp"

namespace orca::simbatch {

/// An archive of a batch that was unpacked and is as it was made.
struct Pack {
  std::filesystem::path experiment;  ///< Where it lies now.
  std::filesystem::path runs;        ///< The exported results that came with it.
  batch::Inputs programs;  ///< Names and hashes of programs, libraries and plugins of those results.
};

/// Writes NAME.pack.tar.gz into the folder of results: the experiment and all files that its runs read, at their places from a
/// common folder on, the exported results, hashes, and REPEAT.md.
/// @param plugins  the folders of plugins.
/// @return the archive.
/// @errors  failed_precondition if the experiment does not load from there, for instance because of an absolute path; unavailable
///          with the system's reason.
/// @pre  check_graphs() found no errors, and the results are complete.
Result<std::filesystem::path> write_pack(const batch::Experiment& experiment, const batch::Store& store,
                                         const std::filesystem::path& folder,
                                         const std::vector<std::string>& plugins);

/// Unpacks an archive into a folder, which must not be there yet.
/// @errors  those of unpack_archive() and open_pack(); unavailable with the system's reason. Then the folder is not there either.
Result<Pack> unpack(const std::filesystem::path& archive, const std::filesystem::path& folder);

/// Looks at an archive that was unpacked into a folder.
/// @errors  failed_precondition with the file that is not as it was, or misses.
Result<Pack> open_pack(const std::filesystem::path& folder);

/// Returns which programs, libraries and plugins are not those of a pack, sorted.
std::vector<std::string> other_programs(const Pack& pack, const batch::Inputs& now);

/// Compares new results with those of a pack, byte for byte, and says what came of it on stdout.
ExitCode compare_with(const Pack& pack, const std::filesystem::path& runs);

/// Prints the files that the runs of an experiment read, a line each: what a process knows that has read nothing else.
/// @param words  the experiment and the folders of plugins.
ExitCode list_files(const std::vector<std::string>& words);

/// The word by which this program starts itself for list_files().
inline constexpr const char* kListFiles = "list-files";

}  // namespace orca::simbatch
