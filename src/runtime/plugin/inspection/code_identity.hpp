// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "elf_file.hpp"

namespace orca::plugin {

/// The identity of one build of a library: its build id, or a hash of its machine code if the linker wrote no
/// build id.
///
/// A plain value.
struct CodeIdentity {
  std::string build_id;         ///< Hexadecimal digits; empty if there is none.
  std::uint64_t code_hash = 0;  ///< Only without a build id.

  friend bool operator==(const CodeIdentity&, const CodeIdentity&) = default;
};

/// Returns the identity of a library in its file.
[[nodiscard]] CodeIdentity identity_of(const ElfFile& file);

/// Returns the identity of a library in this process's memory, which may be another one than that in the file of its name.
/// @param handle  that dlopen() has returned.
[[nodiscard]] CodeIdentity identity_in_memory(void* handle);

}  // namespace orca::plugin
