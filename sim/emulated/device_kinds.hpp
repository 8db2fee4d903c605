// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/emulators/firmware.hpp"
#include "world_body.hpp"

namespace orca::sim {

/// A TCP port of this machine.
struct TcpPlace {
  std::string address = "127.0.0.1";  ///< IPv4.
  std::uint16_t port = 0;             ///< 0: any that is free.
};

/// A device that a robot is to have, as the parameter `lines` names it.
struct DeviceWish {
  std::string kind;                 ///< "p2os"
  std::string model;                ///< "p2dx"; empty: the usual one.
  std::string line;                 ///< As it is written: a name, or a TCP port.
  std::optional<TcpPlace> place{};  ///< If it is a TCP port.
};

/// Reads a list of devices: KIND LINE or KIND:MODEL LINE, with semicolons between them. A line is a name, tcp:PORT or
/// tcp:ADDRESS:PORT.
/// @errors  invalid_argument with what is wrong, and how such a list is written.
[[nodiscard]] Result<std::vector<DeviceWish>> read_devices(std::string_view text);

/// Makes the firmware of a device.
/// @param body  outlives it.
/// @errors  invalid_argument for a kind or a model that is not known, with those that are.
[[nodiscard]] Result<std::unique_ptr<emulators::Firmware>> make_firmware(const DeviceWish& wish,
                                                                         WorldBody& body);

}  // namespace orca::sim
