// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"

namespace {

/// Is not ready in time, or says that it never will be, or has one long lap.
class SlowStarter final : public orca::Component {
 public:
  using Component::Component;

 private:
  orca::Status configure() override {
    sleep(orca::from_seconds(*delay_));
    if (*refuses_) return orca::fail(orca::Code::unavailable, "the moon is in the wrong phase");
    return orca::ok();
  }
  orca::Outcome work() override {
    sleep(orca::from_seconds(*lap_));
    return orca::done();
  }

  orca::Param<double> delay_{*this, "delay", 0.0, {.unit = "s", .min = 0.0}};
  orca::Param<double> lap_{*this, "lap", 0.0, {.unit = "s", .min = 0.0}};
  orca::Param<bool> refuses_{*this, "refuses", false};
};

}  // namespace

ORCA_COMPONENT(SlowStarter, "test.SlowStarter")
