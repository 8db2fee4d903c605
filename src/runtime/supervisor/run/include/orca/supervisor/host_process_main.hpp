// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/base/descriptor.hpp"

namespace orca::supervisor {

/// Runs a part of a system in this process, as the supervisor at the other end of the control channel orders.
///
/// @param channel         this process's end of the control channel.
/// @param plugin_folders  searched before those of the graph.
/// @return 0 if everything was taken down on order; 1 otherwise, after the supervisor was told why.
/// @thread  the main thread, while no other thread exists.
[[nodiscard]] int host_process_main(Descriptor channel, const std::vector<std::string>& plugin_folders);

}  // namespace orca::supervisor
