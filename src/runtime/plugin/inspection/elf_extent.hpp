// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <elf.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace orca::plugin {

/// Returns why a library must not be mapped into memory, in words that follow "is damaged: ". The dynamic linker trusts these
/// numbers: it maps, protects and writes what they say, whoever's memory that is. Nothing if they stay within the library.
///
/// @param segments  the program headers of the file.
/// @source  System V ABI, chapter 5, "Program Header"; _dl_map_segments() and _dl_protect_relro() of glibc.
[[nodiscard]] std::optional<std::string> segment_fault(std::span<const Elf64_Phdr> segments);

/// Returns whether bytes at an address lie in a segment that the library may write.
[[nodiscard]] bool is_writable(std::span<const Elf64_Phdr> segments, std::uint64_t address,
                               std::uint64_t size);

}  // namespace orca::plugin
