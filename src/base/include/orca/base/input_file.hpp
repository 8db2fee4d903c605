// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "orca/base/result.hpp"

namespace orca {

/// Reads a file that people have named: a graph, a world, a picture, a list of goals. It may be a pipe that
/// somebody writes to. Reading ends within 5 s whatever the file is: a pipe without a writer is an error.
///
/// The file is remembered until the process ends, so that no OutputFile overwrites it.
///
/// @param max_bytes  a longer file is cut off there.
/// @errors  not_found with the system's reason if it cannot be opened, data_loss if it cannot be read,
///          deadline_exceeded if a pipe or device gives nothing more and does not end. Throws
///          std::system_error if there is no descriptor or memory left (orca/base/exhaustion.hpp).
/// @thread  any.
[[nodiscard]] Result<std::string> read_input_file(const std::string& path, std::size_t max_bytes);

/// Remembers a file that somebody else reads, now or later, so that no OutputFile overwrites it.
/// @thread  any.
void remember_input_file(const std::string& path);

/// Returns whether `path` leads to a file that read_input_file() has read, also by another name.
/// @thread  any.
[[nodiscard]] bool has_been_read(const std::string& path);

/// Returns the files that read_input_file() has read and remember_input_file() was given, each once, by their paths without
/// links, sorted.
/// @thread  any.
[[nodiscard]] std::vector<std::string> known_input_files();

}  // namespace orca
