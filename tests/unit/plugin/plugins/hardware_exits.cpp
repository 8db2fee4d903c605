// SPDX-License-Identifier: GPL-3.0-or-later
// Hardware whose destructor ends the process.
#include <cstdlib>

#include "orca/hardware.hpp"

namespace {

class Leaves final : public orca::hw::HardwareContainer {
 public:
  using HardwareContainer::HardwareContainer;
  ~Leaves() override { std::_Exit(6); }
  std::vector<orca::HardwareFault> prepare() override { return {}; }
  [[nodiscard]] orca::idl::Robot description() const override { return {}; }

 private:
  orca::Status poll() override { return orca::ok(); }
  [[nodiscard]] orca::TimePoint next_poll() const override { return orca::kForever; }
  orca::Status drive(const orca::hw::DriveSetpoint& /*setpoint*/) override { return orca::ok(); }
};

}  // namespace

ORCA_HARDWARE(Leaves, "test.hw.Leaves")
