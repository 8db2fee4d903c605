// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/system.hpp"

namespace {

/// Describes a robot as a base does, but only after a while, and logs what it was asked about.
class Describer final : public orca::Component {
 public:
  explicit Describer(orca::ComponentHost& host) : Component(host) { lap_every(std::chrono::seconds(1)); }

 private:
  orca::Outcome work() override { return orca::again(); }

  orca::Result<orca::Loan<orca::idl::Robot>> on_ask(const orca::ObjectPtr<orca::idl::Ask>& ask) {
    log_info("is asked about \"" + ask->about() + "\"");
    sleep(orca::from_seconds(*answer_after_));
    if (*radius_ == 0.0) return orca::fail(orca::Code::not_found, "it has no shape");
    auto robot = orca::make_object<orca::idl::Robot>();
    robot->radius(*radius_);
    return robot;
  }

  orca::QueryServer<orca::idl::Ask, orca::idl::Robot> robot_{*this, "RobotQuery", &Describer::on_ask};
  orca::Param<double> answer_after_{*this, "answer_after", 0.0, {.unit = "s", .min = 0.0}};
  orca::Param<double> radius_{*this, "radius", 0.0, {.unit = "m"}};
};

}  // namespace

ORCA_COMPONENT(Describer, "test.Describer")
