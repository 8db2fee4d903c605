// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace orca::plugin {

/// Returns the build id that a linker wrote among the notes of a library, in hexadecimal digits; empty if there is none.
/// The bytes are not trusted.
///
/// @param align  of the segment of notes that the bytes are [bytes]; each note begins at a multiple of it.
/// @source  System V ABI, chapter 5, "Note Section"; NT_GNU_BUILD_ID as in glibc's <elf.h>.
[[nodiscard]] std::string build_id_in(std::span<const std::byte> notes, std::uint64_t align);

}  // namespace orca::plugin
