// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/types.h>

#include <string>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"

namespace orca {

/// Checks that nobody else has put something in the place of a file or folder that this process is about to write, in a folder
/// that everybody may write to, such as /tmp: a symbolic link, a pipe, or a file or folder of their own, or a second name of
/// one of ours. In any other folder, and where nothing is yet, everything is well.
/// @errors  unavailable, with who it belongs to.
/// @thread  any.
[[nodiscard]] Status check_output_place(const std::string& path);

/// A file that is open for writing.
struct OpenOutput {
  Descriptor file;
  bool is_new = false;  ///< It was made just now.
};

/// Opens a file for writing, or makes it, in a place that passes check_output_place(). Nothing is cut off.
/// @param flags  of open(), beside O_CREAT, O_EXCL and O_TRUNC.
/// @errors  unavailable with the system's reason, or that of the check. Throws std::system_error if there are no descriptors
///          left (orca/base/exhaustion.hpp).
/// @thread  any.
[[nodiscard]] Result<OpenOutput> open_output(const std::string& path, int flags, mode_t mode);

}  // namespace orca
