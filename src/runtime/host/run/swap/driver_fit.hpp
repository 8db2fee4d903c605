// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "run/hardware/hardware_instance.hpp"

namespace orca::host {

/// Returns why a driver cannot take the present one's place under its servers, one difference each; empty if it can. It
/// must have the same sensors with the same periods, the same kind of base, and every device that the present one describes.
/// It may have more.
/// @pre  both were constructed.
[[nodiscard]] std::vector<std::string> driver_misfits(HardwareInstance& present, HardwareInstance& offered);

}  // namespace orca::host
