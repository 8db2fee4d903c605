// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <string>

#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"

namespace {

/// Serves whoever uses it, by all three patterns, and logs with the number of its process what it is used for.
class Visited final : public orca::Component {
 public:
  explicit Visited(orca::ComponentHost& host) : Component(host) { lap_every(std::chrono::milliseconds(20)); }

 private:
  orca::Status configure() override {
    say("is loaded");
    return orca::ok();
  }

  orca::Status start() override {
    say("has a listener");
    return orca::ok();
  }

  orca::Outcome work() override {
    out_.push(out_.loan());
    return orca::again();
  }

  void stop() override { say("has no listener"); }

  orca::Status on_goal(const orca::ObjectPtr<orca::idl::GoalPoint>& /*goal*/) {
    say("handles what was sent");
    return orca::ok();
  }

  orca::Result<orca::Loan<orca::idl::GoalPoint>> on_ask(const orca::ObjectPtr<orca::idl::Ask>& /*ask*/) {
    sleep(orca::from_seconds(*answer_time_));
    say("answers");
    return orca::make_object<orca::idl::GoalPoint>();
  }

  void say(const std::string& what) const { log_info(what + " in process " + std::to_string(getpid())); }

  orca::PushServer<orca::idl::Odometry> out_{*this, "out"};
  orca::SendServer<orca::idl::GoalPoint> goal_{*this, "goal", &Visited::on_goal};
  orca::QueryServer<orca::idl::Ask, orca::idl::GoalPoint> ask_{*this, "ask", &Visited::on_ask};
  orca::Param<double> answer_time_{*this, "answer_time", 0.0, {.unit = "s", .min = 0.0}};
};

}  // namespace

ORCA_COMPONENT(Visited, "test.Visited")
