// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/hardware.hpp"
#include "orca/idl/time.hpp"

namespace {

/// A device that touches a wall after 0.5 s and breaks after 1 s.
class Brittle final : public orca::hw::HardwareContainer {
 public:
  using HardwareContainer::HardwareContainer;

 private:
  std::vector<orca::HardwareFault> prepare() override { return {}; }
  [[nodiscard]] orca::idl::Robot description() const override { return {}; }
  orca::Status drive(const orca::hw::DriveSetpoint& /*setpoint*/) override { return orca::ok(); }

  orca::Status open() override {
    next_ = host().now() + kStep;
    return orca::ok();
  }

  [[nodiscard]] orca::TimePoint next_poll() const override { return next_; }

  orca::Status poll() override {
    if (touched_) return orca::fail(orca::Code::unavailable, "the cable is off");
    touched_ = true;
    orca::idl::Contact contact;
    contact.robot() = "Dewey";
    contact.other() = "wall";
    contact.x(2.0);
    contact.stamp(orca::to_time_value(host().now()));
    host().report(contact);
    next_ = host().now() + kStep;
    return orca::ok();
  }

  static constexpr orca::Duration kStep = std::chrono::milliseconds(500);
  orca::TimePoint next_;
  bool touched_ = false;
};

}  // namespace

ORCA_HARDWARE(Brittle, "test.Brittle")
