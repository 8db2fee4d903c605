// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/emulators/firmware.hpp"
#include "world_body.hpp"

namespace orca::sim {

/// A device that a robot is to have, as the parameter `lines` names it.
struct DeviceWish {
  std::string kind;   ///< "p2os"
  std::string model;  ///< "p2dx"; empty: the usual one.
  std::string place;  ///< Name of its line, or listen:[ADDRESS:]PORT.
};

/// Reads a list of devices: KIND PLACE or KIND:MODEL PLACE, with semicolons between them.
/// @errors  invalid_argument with what is wrong, and how such a list is written.
[[nodiscard]] Result<std::vector<DeviceWish>> read_devices(std::string_view text);

/// Makes the firmware of a device.
/// @param body  outlives it.
/// @errors  invalid_argument for a kind or a model that is not known, with those that are.
[[nodiscard]] Result<std::unique_ptr<emulators::Firmware>> make_firmware(const DeviceWish& wish,
                                                                         WorldBody& body);

}  // namespace orca::sim
