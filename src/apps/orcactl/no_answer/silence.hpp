// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <sys/types.h>

#include <string>

#include "common/command_line.hpp"
#include "orca/base/time.hpp"

namespace orca::orcactl {

/// [s] without an answer, after which the user hears of it. A deployer waits 2 s for those of other machines.
inline constexpr Duration kSilence = 2200ms;

/// Returns what the user hears of a deployer that has not answered a command for kSilence, and what to do about it.
/// @param deployer  its process; 0: not known.
/// @return empty if there is nothing to say: it may well be at work.
[[nodiscard]] std::string silence_text(const apps::Call& call, pid_t deployer);

}  // namespace orca::orcactl
