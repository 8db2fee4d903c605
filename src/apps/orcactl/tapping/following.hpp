// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <set>
#include <string>

#include "client.hpp"
#include "common/command_line.hpp"
#include "orca/base/result.hpp"

namespace orca::orcactl {

/// Finds the port that a word of --from or --to means: its name; its name without "Push" or "Send", in any case
/// ("base.odometry"); or "wheels", the only port MotionCommandSend.
/// @errors  invalid_argument if "wheels" could mean several ports, or none. A word that means nothing is returned as it is.
[[nodiscard]] Result<std::string> port_meant_by(const std::string& word, const std::set<std::string>& ports);

/// Carries out latency with --from and --to: measures from the moment when data were sensed until an object arrives that
/// was sent because of them.
[[nodiscard]] Status follow(Client& client, const apps::Call& call);

}  // namespace orca::orcactl
