// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "device_line.hpp"
#include "orca/base/descriptor.hpp"
#include "orca/emulators/firmware.hpp"
#include "orca/hw/link/pty_link.hpp"

namespace orca::sim {

/// An emulated device at a pseudo terminal, which a driver opens as emulated:NAME.
///
/// Thread contract: one strand.
class TerminalLine final : public DeviceLine {
 public:
  TerminalLine(std::string name, std::unique_ptr<emulators::Firmware> firmware);

  /// @errors  already_exists if another system offers a line of that name; those of PtyLink::open().
  Status open() override;
  void close() override;
  bool exchange(TimePoint now) override;
  [[nodiscard]] std::string name() const override { return "emulated:" + name_; }

 private:
  const std::string name_;
  const std::string path_;
  Descriptor lock_;  // of the name, while it is open
  hw::link::PtyLink link_;
  std::unique_ptr<emulators::Firmware> firmware_;
};

}  // namespace orca::sim
