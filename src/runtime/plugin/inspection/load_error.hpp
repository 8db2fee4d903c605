// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "elf_file.hpp"

namespace orca::plugin {

/// Why the system's loader has refused a library: all needed libraries that are not found, else all symbols
/// that nobody provides, else the loader's own words.
///
/// @param path   of the library, absolute.
/// @param words  what the loader said.
[[nodiscard]] std::string explain_load_error(const ElfFile& library, const std::string& path,
                                             const std::string& words);

}  // namespace orca::plugin
