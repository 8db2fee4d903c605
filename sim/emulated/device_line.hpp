// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"
#include "orca/emulators/firmware.hpp"
#include "orca/hw/link/byte_link.hpp"
#include "orca/hw/link/pty_link.hpp"

namespace orca::sim {

/// With what the place of a device begins that listens in the network.
inline constexpr std::string_view kListens = "listen:";

/// An emulated device with its line, which a driver opens as emulated:NAME, or with the port at which it listens, which a driver opens as
/// emulated:tcp:PORT, and programs of others as tcp:HOST:PORT.
///
/// Thread contract: one strand.
class DeviceLine {
 public:
  /// @param place  name of the line, or listen:[ADDRESS:]PORT as make_link() reads it.
  DeviceLine(const std::string& place, std::unique_ptr<emulators::Firmware> firmware);

  /// @errors  already_exists if another system offers a line of that name; those of PtyLink::open() and ListenLink::open().
  Status open();
  void close();
  /// Passes bytes on, as the line's rate allows.
  /// @return whether a driver has the line open.
  bool exchange(TimePoint now);

 private:
  [[nodiscard]] Status lock_name();

  const std::string name_;
  std::unique_ptr<hw::link::ByteLink> link_;
  hw::link::PtyLink* terminal_ = nullptr;  // the link, if it is one
  Descriptor lock_;                        // of the terminal's name, while it is open
  std::unique_ptr<emulators::Firmware> firmware_;
};

}  // namespace orca::sim
