// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "elf_file.hpp"

namespace orca::plugin {

/// Explains why the system's loader has rejected a library. The text names all needed libraries that are not
/// found, else all symbols that no library provides, else it repeats the loader's message.
///
/// @param path   absolute path of the library.
/// @param words  the loader's message.
[[nodiscard]] std::string explain_load_error(const ElfFile& library, const std::string& path,
                                             const std::string& words);

}  // namespace orca::plugin
