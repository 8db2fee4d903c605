// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "elf_file.hpp"

namespace orca::plugin {

/// Returns whether the loader's message says that memory is missing: glibc does not always keep the system's error number.
[[nodiscard]] bool says_no_memory(std::string_view words);

/// Explains why the system's loader has rejected a library. The text names all needed libraries that are not
/// found, else all symbols that no library provides, else it repeats the loader's message.
///
/// @errors  throws std::bad_alloc if a library that it needs finds no memory.
/// @param path   absolute path of the library.
/// @param words  the loader's message.
[[nodiscard]] std::string explain_load_error(const ElfFile& library, const std::string& path,
                                             const std::string& words);

}  // namespace orca::plugin
