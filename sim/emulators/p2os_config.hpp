// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "orca/emulators/p2os_firmware.hpp"

namespace orca::emulators {

/// Returns the body of the packet with which a controller tells what it is and how it is set.
/// @param gripper  Kind of gripper; 0: none.
/// @source  ARCOS, "Configuration packet".
[[nodiscard]] std::vector<std::uint8_t> p2os_config(const P2osSettings& settings, unsigned gripper);

}  // namespace orca::emulators
