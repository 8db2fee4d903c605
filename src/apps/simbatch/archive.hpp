// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <filesystem>

#include "orca/base/result.hpp"

namespace orca::simbatch {

/// Writes everything in a folder into a compressed tar archive. The same files give the same bytes: it holds no dates and owners.
/// @errors  those of output_of() for `tar`.
Status write_archive(const std::filesystem::path& archive, const std::filesystem::path& folder);

/// Unpacks an archive of write_archive() into a folder. Nothing is unpacked of an archive that holds anything else than files and folders, a
/// path that leads out of the folder, a path twice, more than 100,000 files, or more than 4 GB.
/// @errors  invalid_argument with the path; those of output_of() for `tar`.
Status unpack_archive(const std::filesystem::path& archive, const std::filesystem::path& folder);

}  // namespace orca::simbatch
