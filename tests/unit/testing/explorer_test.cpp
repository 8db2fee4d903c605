// SPDX-License-Identifier: GPL-3.0-or-later
// An Explorer and who gives it goals.
#include <catch2/catch.hpp>

#include "orca/idl/hardware.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/testing/component_trial.hpp"

using namespace orca;
using namespace orca::testing;
using namespace std::chrono_literals;

namespace {

struct Sender final : Partner {
  using Partner::Partner;
  PushServer<idl::RobotPose> localizer{*this, "localizer"};
  PushServer<idl::OccupancyGrid> map{*this, "map"};
  PushServer<idl::Arrived> arrived{*this, "arrived"};
  PushServer<idl::GoalFailed> failed{*this, "failed"};
  QueryServer<idl::Ask, idl::Robot> robot{*this, "robot", &Sender::on_question};
  SendServer<idl::GoalPoint> goto_{*this, "goto", &Sender::on_goal};
  SendProxy<idl::GoalPoint> goal{*this, "GotoCoordinateSend"};
  PushProxy<idl::GoalFailed> undone{*this, "GoalFailedPush"};

  Status on_goal(const ObjectPtr<idl::GoalPoint>& /*point*/) { return ok(); }

  Result<Loan<idl::Robot>> on_question(const ObjectPtr<idl::Ask>& /*ask*/) {
    return make_object<idl::Robot>();
  }

  // Returns why the Explorer does not take a goal before which it explores; empty: it takes it.
  std::string refusal(double time_limit) {
    auto there = goal.loan();
    there->name() = "explore";
    there->time_limit(time_limit);
    REQUIRE(goal.send(std::move(there)).ok());
    sleep(100ms);
    return undone.new_data_arrived() ? undone.get_update()->reason() : "";
  }
};

}  // namespace

TEST_CASE("an Explorer takes no goal whose time limit is negative", "[testing][explorer]") {
  try_component<Sender>({.type = "orca.Explorer"}, [](Sender& sender) {
    sender.undone.subscribe();
    CHECK(sender.refusal(10.0).empty());
    CHECK(sender.refusal(-1.0) == "refused: it has a time_limit that is negative, or no number");
  });
}
