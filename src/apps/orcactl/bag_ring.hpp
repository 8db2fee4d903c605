// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/recording/mcap.hpp"

namespace orca::orcactl {

/// Returns a time since 1970 as people read it: "2026-11-29 14:03:22 +0100", in the zone of this machine.
[[nodiscard]] std::string local_time(recording::Stamp time);

/// Returns the folder of a recording without an end that a word names: a folder, or a system with record="always"; empty: it
/// names neither.
[[nodiscard]] std::string ring_folder(const std::string& word);

/// Shows what such a folder holds, while it is written, too.
/// @errors  not_found if there is no recording in it.
Status show_ring(const std::string& folder, bool as_json);

/// Writes what a file or a folder holds of a span of time into a new file.
/// @param words  the file, the folder or the system; the new file; from when and to when: "14:03", "14:03:20",
///               "2026-11-29T14:03:20", or "90 s" since its beginning; all of it if they are missing.
/// @errors  invalid_argument; not_found if there is nothing of that time; as Reader and Writer.
Status cut(const std::vector<std::string>& words);

}  // namespace orca::orcactl
