// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>
#include <vector>

namespace orca::hwprobe {

/// Returns the serial ports of this machine that may have a device: adapters by their names in by-id, those without such a name by
/// their path, and the board's own ports that exist. Each port once.
/// @param folder  of the devices: /dev.
[[nodiscard]] std::vector<std::string> serial_ports(const std::string& folder = "/dev");

}  // namespace orca::hwprobe
