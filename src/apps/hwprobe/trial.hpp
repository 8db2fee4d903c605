// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/idl/hardware.hpp"

namespace orca::hwprobe {

/// What a driver has found at a port.
struct Finding {
  bool answers = false;
  std::string reason;                 ///< If it does not: why, and what to do.
  std::vector<std::string> said{};    ///< By the driver, about the device.
  idl::Robot what{};                  ///< The device, as the driver describes it.
  std::vector<std::string> data{};    ///< The first object of each sensor that gave one, in its text form.
  std::vector<std::string> silent{};  ///< The object types of the others.
  idl::DeviceStatistics line{};
};

/// A hardware type that drives a device at a port.
struct Driver {
  std::string type;
  std::string usual_line;  ///< The default of its parameter "device".

  /// Returns whether its device may be at a port. A driver whose usual line is a connection has none at serial ports.
  [[nodiscard]] bool may_be_at(std::string_view port) const;
};

/// Returns all drivers: the hardware types with a parameter "device".
[[nodiscard]] std::vector<Driver> drivers(host::PluginCatalogue& catalogue);

/// Lets a driver look for its device at a port and, if that answers, waits for its first data. Motors get no power.
/// @param limit  [s] for an answer, and once more for data.
/// @errors  those of PluginCatalogue::acquire(); invalid_argument if the driver cannot use such a port.
/// @thread  main; it blocks.
[[nodiscard]] Result<Finding> try_driver(host::PluginCatalogue& catalogue, const std::string& type,
                                         const std::string& port, Duration limit);

/// Opens a port and closes it again.
/// @errors  why it cannot be opened, with what to do.
[[nodiscard]] Status try_port(const std::string& port);

}  // namespace orca::hwprobe
