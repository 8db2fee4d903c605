// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"

namespace orca::sim {

/// An emulated device with the line at which hosts find it.
///
/// Thread contract: one strand.
class DeviceLine {
 public:
  virtual ~DeviceLine() = default;

  /// Offers the line.
  /// @errors  already_exists if another system offers it; others of its kind, with what to do.
  virtual Status open() = 0;
  virtual void close() = 0;
  /// Passes bytes on, as the line's rate allows, and lets the device go on.
  /// @return whether a host has the line open.
  virtual bool exchange(TimePoint now) = 0;
  /// Returns what a driver's parameter `device` names on this machine. @pre  it was opened.
  [[nodiscard]] virtual std::string name() const = 0;
};

}  // namespace orca::sim
