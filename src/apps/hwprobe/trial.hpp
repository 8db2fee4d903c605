// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/idl/hardware.hpp"

namespace orca::hwprobe {

/// Names and values of parameters.
using Learned = std::vector<std::pair<std::string, std::string>>;

/// What a driver has found at a port.
struct Finding {
  bool answers = false;
  std::string reason;                 ///< If it does not: why, and what to do.
  std::vector<std::string> said{};    ///< By the driver, about the device.
  idl::Robot what{};                  ///< The device, as the driver describes it.
  std::vector<std::string> data{};    ///< The latest object of each sensor that gave one, in its text form.
  std::vector<std::string> silent{};  ///< The object types of the others.
  idl::DeviceStatistics line{};
  Learned learned{};  ///< Parameters with which it was looked at, because the device calls for them.
};

/// How long to look, and what to do meanwhile.
struct Look {
  Duration limit;                      ///< [s] For an answer, and once more for data.
  std::function<bool()> is_stopped{};  ///< Asked again and again; true: no longer.
  std::function<void(const Finding&)>
      show{};  ///< If set: called each second with the latest data, until is_stopped().
};

/// Where devices are found.
enum class Place { serial, network, camera };

/// A hardware type that drives a device at a port: one with a parameter "device".
struct DriverType {
  std::string name;
  Place place =
      Place::serial;  ///< Where its device is usually found, by what that parameter is unless given.
};

[[nodiscard]] std::vector<DriverType> drivers(host::PluginCatalogue& catalogue);

/// Returns where a port leads.
[[nodiscard]] Place place_of(std::string_view port);

/// Lets a driver look for its device at a port and, if that answers, waits for data of all sensors. Motors get no power. A device that
/// calls for other parameters is looked at once more with them.
/// @errors  those of PluginCatalogue::acquire(); invalid_argument if the driver cannot use such a port.
/// @thread  main; it blocks.
[[nodiscard]] Result<Finding> try_driver(host::PluginCatalogue& catalogue, const std::string& type,
                                         const std::string& port, const Look& look);

/// Opens a port that is no camera and closes it again.
/// @errors  why it cannot be opened, with what to do.
[[nodiscard]] Status try_port(const std::string& port);

}  // namespace orca::hwprobe
