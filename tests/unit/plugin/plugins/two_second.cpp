// SPDX-License-Identifier: GPL-3.0-or-later
// The other of two types of one plugin: hardware whose preparation fails.
#include <stdexcept>

#include "orca/hardware.hpp"

namespace {

class Two final : public orca::hw::HardwareContainer {
 public:
  using HardwareContainer::HardwareContainer;
  std::vector<std::string> prepare() override {
    if (mode_->empty()) return {"robot.xml:3:1: there is no radius"};
    if (*mode_ == "throw") throw std::runtime_error("the robot file smokes");
    return {};
  }
  [[nodiscard]] orca::idl::Robot description() const override { return {}; }

 private:
  orca::Status poll() override { return orca::ok(); }
  [[nodiscard]] orca::TimePoint next_poll() const override { return orca::kForever; }
  orca::Status drive(const orca::hw::DriveSetpoint& /*setpoint*/) override { return orca::ok(); }

  orca::Param<std::string> mode_{*this, "mode", "", {.text = "What to do."}};
};

}  // namespace

ORCA_HARDWARE(Two, "test.hw.Second")
