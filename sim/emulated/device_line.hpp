// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"
#include "orca/emulators/firmware.hpp"
#include "orca/hw/link/pty_link.hpp"

namespace orca::sim {

/// An emulated device with its line, which a driver opens as emulated:NAME.
///
/// Thread contract: one strand.
class DeviceLine {
 public:
  DeviceLine(std::string name, std::unique_ptr<emulators::Firmware> firmware);

  /// @errors  already_exists if another system offers a line of that name; those of PtyLink::open().
  Status open();
  void close();
  /// Passes bytes on, as the line's rate allows.
  /// @return whether a driver has the line open.
  bool exchange(TimePoint now);

 private:
  const std::string name_;
  const std::string path_;
  Descriptor lock_;  // of the name, while it is open
  hw::link::PtyLink link_;
  std::unique_ptr<emulators::Firmware> firmware_;
};

}  // namespace orca::sim
