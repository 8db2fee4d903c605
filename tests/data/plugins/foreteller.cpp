// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"
#include "orca/idl/moving.hpp"
#include "orca/idl/time.hpp"

namespace {

/// Says ten times a second that nobody moves, as by a clock that is ahead of the system's.
class Foreteller final : public orca::Component {
 public:
  explicit Foreteller(orca::ComponentHost& host) : Component(host) {
    lap_every(std::chrono::milliseconds(100));
  }

 private:
  orca::Outcome work() override {
    auto nobody = moving_.loan();
    nobody->stamp(orca::to_time_value(now() + orca::from_seconds(*ahead_)));
    moving_.push(std::move(nobody));
    return orca::again();
  }

  orca::PushServer<orca::idl::MovingThings> moving_{*this, "MovingThingsPush"};
  orca::Param<double> ahead_{*this, "ahead", 0.0, {.unit = "s"}};
};

}  // namespace

ORCA_COMPONENT(Foreteller, "test.Foreteller")
