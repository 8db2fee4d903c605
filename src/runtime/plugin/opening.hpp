// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"

namespace orca::plugin {

inline constexpr Duration kTrialLimit = 5s;  ///< [s] For what a library does when it is tried out.

/// Opens a library for a trial, and calls std::terminate() if its static initialisation throws, as a process without a handler does.
/// @return null if the system's loader refuses it.
[[nodiscard]] void* try_to_open(const char* file) noexcept;

/// Opens a library for good. Settings that all share are put back, with a warning, if its static initialisation changes them.
///
/// @param path   for people.
/// @param file   to open, with a folder.
/// @param flags  of dlopen(), besides RTLD_NOW and RTLD_LOCAL.
/// @errors  invalid_argument with all libraries that are missing, or else all symbols. Throws std::bad_alloc if there is no memory.
/// @thread  any; one call at a time.
[[nodiscard]] Result<void*> open_library(const std::string& path, const std::string& file, int flags = 0);

}  // namespace orca::plugin
