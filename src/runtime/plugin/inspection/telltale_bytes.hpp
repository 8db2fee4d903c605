// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace orca::plugin {

/// Returns the instructions in machine code that read a clock or draw random numbers without a function: "rdtsc",
/// "rdtscp", "rdrand", "rdseed". Each is named once. Machine code for another processor than x86-64 has none.
///
/// An instruction is found if it is followed, within 24 bytes, by what compilers put behind it: a shift by 32 bits, or
/// a look at the carry flag. Its own two or three bytes also occur by chance. Code that a person has written in
/// assembler may therefore be missed.
[[nodiscard]] std::vector<std::string_view> telltale_instructions(std::span<const std::byte> code);

/// Returns the paths in a plugin's bytes whose files differ from run to run: "/dev/random", "/dev/urandom",
/// "/dev/hwrng", "/proc/". Each is named once. A path that the plugin composes at run time is not found.
[[nodiscard]] std::vector<std::string_view> telltale_paths(std::span<const std::byte> bytes);

/// Returns a function that does the same as the instruction or the file, by its name for unfit_for_virtual_time().
[[nodiscard]] std::string_view function_like(std::string_view telltale);

}  // namespace orca::plugin
