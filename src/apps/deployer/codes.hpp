// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
// The codes of what can be wrong with a command line. docs/errors-elsewhere.md explains them; a test compares the two. The
// meaning of a code never changes.
#pragma once

namespace orca::deployer::codes {

inline constexpr const char* kUnknownOption = "C001";
inline constexpr const char* kOptionValue = "C002";
inline constexpr const char* kOptionTwice = "C003";
inline constexpr const char* kExcluding = "C004";
inline constexpr const char* kFiles = "C005";
// Of a <change>: what only shows when the other graph is read.
inline constexpr const char* kChange = "G074";

}  // namespace orca::deployer::codes
