// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "orca/component.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/system.hpp"

namespace {

/// Sends to and queries the components that the graph connects, in each lap, and logs the results.
class Poker final : public orca::Component {
 public:
  explicit Poker(orca::ComponentHost& host) : Component(host) { lap_every(std::chrono::milliseconds(200)); }

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    if (goal_.connected()) say("sent", goal_.send(goal_.loan()));
    if (robot_.connected()) {
      const auto answer = robot_.query(robot_.loan());
      say("asked", answer ? orca::ok() : orca::Status(answer.error()));
    }
    return orca::again();
  }

  void say(const std::string& what, const orca::Status& status) const {
    log_info(what + ": " + (status.ok() ? "ok" : status.error().text()));
  }

  orca::SendProxy<orca::idl::GoalPoint> goal_{*this, "goal", {.optional = true}};
  orca::QueryProxy<orca::idl::Ask, orca::idl::Robot> robot_{*this, "robot", {.optional = true}};
};

}  // namespace

ORCA_COMPONENT(Poker, "test.Poker")
