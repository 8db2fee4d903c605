// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca::supervisor {

/// The name in the log of what the supervisor itself has to say, and what is said about it. It is the program's: people
/// have started a deployer.
inline constexpr const char* kLogName = "deployer";

}  // namespace orca::supervisor
