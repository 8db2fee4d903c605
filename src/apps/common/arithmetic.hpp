// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>

namespace orca::apps {

/// Lets sin(), exp() and the like give the same bits on every x86-64 processor (ADR 0032). The C library chooses
/// among its variants of them when a program starts, and those that fuse multiplication and addition round
/// differently. Where it has chosen them, this function starts the program anew without them: same process,
/// arguments, signals and open files. If that is not possible, the program goes on as it is.
///
/// To be called before anything else that the new start would repeat or lose.
void choose_portable_arithmetic(char** arguments);

/// Returns the GLIBC_TUNABLES that make the C library leave the fused variants out.
/// @param tunables  those of the user, which are kept; empty: none.
[[nodiscard]] std::string with_portable_arithmetic(const std::string& tunables);

}  // namespace orca::apps
