// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>
#include <string>

#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"

namespace {

/// Drives ahead, and says where the cart is and whether a reading is missing.
class Rider final : public orca::Component {
 public:
  explicit Rider(orca::ComponentHost& host) : Component(host) { lap_every(std::chrono::milliseconds(20)); }

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    auto command = motion_.loan();
    command->kind(orca::idl::NORMAL);
    command->speed(0.4);
    if (const orca::Status sent = motion_.send(std::move(command)); !sent.ok())
      log_debug("not sent: " + sent.error().text());
    while (odometry_.new_data_arrived()) {
      const auto reading = odometry_.get_update();
      if (last_ != 0 && reading->seq() != last_ + 1) log_debug("gap after " + std::to_string(last_));
      last_ = reading->seq();
      log_debug("reading " + std::to_string(last_));
    }
    return orca::again();
  }

  orca::PushProxy<orca::idl::Odometry> odometry_{*this, "odometry"};
  orca::SendProxy<orca::idl::MotionCommand> motion_{*this, "motion"};
  std::uint64_t last_ = 0;
};

}  // namespace

ORCA_COMPONENT(Rider, "test.Rider")
