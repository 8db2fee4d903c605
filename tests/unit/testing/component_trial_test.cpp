// SPDX-License-Identifier: GPL-3.0-or-later
// The bench on which an author tries one component.
#include "orca/testing/component_trial.hpp"

#include <catch2/catch.hpp>

#include <numbers>
#include <stdexcept>

#include "orca/geometry/objects/covariance.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"

using namespace orca;
using namespace orca::testing;
using namespace std::chrono_literals;
using Catch::Contains;

namespace {

struct AvoidPorts final : Partner {
  using Partner::Partner;
  PushServer<idl::SonarRangeReadings> ranges{*this, "ranges"};
  PushProxy<idl::MotionCommand> motion{*this, "motion"};
};

struct GotoPorts final : Partner {
  using Partner::Partner;
  SendProxy<idl::GoalPoint> goal{*this, "GotoCoordinateSend"};
  SendProxy<idl::GoalFailed> cancel{*this, "CancelSend"};
  PushServer<idl::RobotPose> pose{*this, "localizer"};
  PushProxy<idl::MotionCommand> motion{*this, "MotionCmdPush"};
  PushProxy<idl::Arrived> arrived{*this, "ArrivedPush"};
  PushProxy<idl::GoalFailed> failed{*this, "GoalFailedPush"};
  PushProxy<idl::Path> path{*this, "PathPush", {.depth = 4}};
};

struct OdometryPorts final : Partner {
  using Partner::Partner;
  SendProxy<idl::GoalPoint> goal{*this, "GotoCoordinateSend"};
  PushServer<idl::Odometry> odometry{*this, "odometry"};
  PushProxy<idl::MotionCommand> motion{*this, "MotionCmdPush"};
  PushProxy<idl::Arrived> arrived{*this, "ArrivedPush"};
};

struct PlannerPorts final : Partner {
  using Partner::Partner;
  SendProxy<idl::GoalPoint> goal{*this, "GotoCoordinateSend"};
  PushServer<idl::LaserRangeReadings> laser{*this, "laser"};
  PushServer<idl::Odometry> odometry{*this, "odometry"};
  PushProxy<idl::GoalFailed> failed{*this, "GoalFailedPush"};
};

struct WrongType final : Partner {
  using Partner::Partner;
  PushServer<idl::RobotPose> ranges{*this, "ranges"};
};

struct NoSuchPort final : Partner {
  using Partner::Partner;
  PushServer<idl::SonarRangeReadings> range{*this, "range"};
};

const std::vector<std::string> kTestPlugins{ORCA_BINARY_DIR "/tests/plugins"};
const Trial kAvoid{.type = "orca.Avoid", .plugins = kTestPlugins};

void push_pose(GotoPorts& test, double x) {
  auto pose = test.pose.loan();
  pose->x(x);
  pose->stamp(to_time_value(test.now()));
  test.pose.push(std::move(pose));
}

void send_goal(GotoPorts& test, double x) {
  auto goal = make_object<idl::GoalPoint>();
  goal->name() = "ahead";
  goal->reach_radius().distance(0.3);
  goal->coordinate().point().x(x);
  REQUIRE(test.goal.send(std::move(goal)).ok());
}

template <class Ports>
void try_for_nothing(const Trial& trial) {
  try_component<Ports>(trial, [](Ports& /*test*/) {});
}

}  // namespace

TEST_CASE("a component that takes goals by Send is driven to its goal by poses that the test pushes",
          "[testing]") {
  bool drove = false;
  bool arrived = false;
  try_component<GotoPorts>({.type = "orca.Goto"}, [&](GotoPorts& test) {
    send_goal(test, 2.0);
    push_pose(test, 0.0);
    drove = test.motion.get_update_wait()->speed() > 0.1;
    for (int i = 0; i < 100 && !test.arrived.new_data_arrived(); ++i) {
      push_pose(test, 1.9);
      test.sleep(50ms);
    }
    arrived = test.arrived.new_data_arrived();
  });
  CHECK(drove);
  CHECK(arrived);
}

TEST_CASE(
    "Goto ends a goal as lost when its localizer says that the robot may be anywhere, and says of no other "
    "one that it is there",
    "[testing][goto]") {
  std::string reason;
  bool stood = false;
  bool arrived = false;
  try_component<GotoPorts>({.type = "orca.Goto"}, [&](GotoPorts& test) {
    send_goal(test, 2.0);
    push_pose(test, 0.0);
    test.sleep(50ms);
    auto pose = test.pose.loan();
    pose->covariance(anywhere());
    pose->stamp(to_time_value(test.now()));
    test.pose.push(std::move(pose));
    reason = test.failed.get_update_wait()->reason();
    send_goal(test, 2.0);
    for (int i = 0; i < 20; ++i) {
      pose = test.pose.loan();
      pose->x(2.0);
      pose->covariance(anywhere());
      pose->stamp(to_time_value(test.now()));
      test.pose.push(std::move(pose));
      test.sleep(50ms);
    }
    stood = test.motion.latest()->kind() != idl::NORMAL;
    arrived = test.arrived.new_data_arrived();
  });
  CHECK(reason == "lost: it is not known any more where the robot is");
  CHECK(stood);
  CHECK_FALSE(arrived);
}

TEST_CASE("Goto keeps a goal until it is known for the first time where the robot is", "[testing][goto]") {
  bool stood = false;
  bool failed = true;
  bool drove = false;
  try_component<GotoPorts>({.type = "orca.Goto"}, [&](GotoPorts& test) {
    auto pose = test.pose.loan();
    pose->covariance(anywhere());
    pose->stamp(to_time_value(test.now()));
    test.pose.push(std::move(pose));
    send_goal(test, 2.0);
    for (int i = 0; i < 20; ++i) {
      pose = test.pose.loan();
      pose->covariance(anywhere());
      pose->stamp(to_time_value(test.now()));
      test.pose.push(std::move(pose));
      test.sleep(50ms);
    }
    stood = test.motion.latest()->kind() == idl::FULLSTOP;
    failed = test.failed.new_data_arrived();
    push_pose(test, 0.0);
    test.sleep(100ms);
    drove = test.motion.latest()->kind() == idl::NORMAL;
  });
  CHECK(stood);
  CHECK_FALSE(failed);
  CHECK(drove);
}

TEST_CASE(
    "Goto with lost_wait leaves a lost robot to others, drives on when it is found, and waits no longer",
    "[testing][goto]") {
  const auto be_lost = [](GotoPorts& test, int laps) {
    for (int i = 0; i < laps; ++i) {
      auto pose = test.pose.loan();
      pose->covariance(anywhere());
      pose->stamp(to_time_value(test.now()));
      test.pose.push(std::move(pose));
      test.sleep(50ms);
    }
  };
  std::vector<idl::MotionKind> kinds;
  bool failed_early = true;
  std::string reason;
  try_component<GotoPorts>({.type = "orca.Goto", .params = {{"lost_wait", "5 s"}}}, [&](GotoPorts& test) {
    send_goal(test, 2.0);
    push_pose(test, 0.0);
    test.sleep(50ms);
    kinds.push_back(test.motion.latest()->kind());
    be_lost(test, 80);
    kinds.push_back(test.motion.latest()->kind());
    push_pose(test, 0.0);
    test.sleep(50ms);
    kinds.push_back(test.motion.latest()->kind());
    be_lost(test, 80);
    failed_early = test.failed.new_data_arrived();
    be_lost(test, 30);
    reason = test.failed.get_update_wait()->reason();
  });
  CHECK(kinds == std::vector{idl::NORMAL, idl::DONTCARE, idl::NORMAL});
  CHECK_FALSE(failed_early);
  CHECK(reason == "lost: it is not known any more where the robot is");
}

TEST_CASE("Goto ends a goal as lost if it is not known within 20 s where the robot is", "[testing][goto]") {
  std::string reason;
  int until = 0;  // [0.1 s]
  try_component<GotoPorts>({.type = "orca.Goto"}, [&](GotoPorts& test) {
    send_goal(test, 2.0);
    for (; until < 300 && !test.failed.new_data_arrived(); ++until) {
      auto pose = test.pose.loan();
      pose->covariance(anywhere());
      pose->stamp(to_time_value(test.now()));
      test.pose.push(std::move(pose));
      test.sleep(100ms);
    }
    if (test.failed.new_data_arrived()) reason = test.failed.get_update()->reason();
  });
  CHECK(reason == "lost: it is not known any more where the robot is");
  CHECK(until == Approx(200).margin(2));
}

TEST_CASE("Goto gives a goal up when it is told so, by its name or without one, and drives to the next one",
          "[testing][goto]") {
  std::vector<std::string> reasons;
  bool stood = false;
  bool arrived = false;
  try_component<GotoPorts>({.type = "orca.Goto"}, [&](GotoPorts& test) {
    const auto cancel = [&](const std::string& name, const std::string& reason) {
      auto order = make_object<idl::GoalFailed>();
      order->name() = name;
      order->reason() = reason;
      return test.cancel.send(std::move(order)).ok();
    };
    for (const char* name : {"ahead", ""}) {
      send_goal(test, 2.0);
      push_pose(test, 0.0);
      test.sleep(50ms);
      cancel("hall", "");  // the robot does not drive there
      test.sleep(50ms);
      cancel(name, name);
      reasons.push_back(test.failed.get_update_wait()->reason());
      push_pose(test, 0.0);
      test.sleep(50ms);
      stood = test.motion.latest()->kind() != idl::NORMAL;
    }
    send_goal(test, 2.0);
    push_pose(test, 2.0);
    arrived = test.arrived.get_update_wait() != nullptr;
  });
  CHECK(reasons == std::vector<std::string>{"cancelled: by \"test\", ahead", "cancelled: by \"test\""});
  CHECK(stood);
  CHECK(arrived);
}

TEST_CASE("a planner that gives a goal up because its laser sees the robot itself says so", "[testing]") {
  std::string reason;
  const Trial trial{.type = "orca.GridPlanner", .params = {{"blocked_after", "5 s"}}};
  try_component<PlannerPorts>(trial, [&](PlannerPorts& test) {
    auto goal = make_object<idl::GoalPoint>();
    goal->reach_radius().distance(0.3);
    goal->coordinate().point().x(4.0);
    REQUIRE(test.goal.send(std::move(goal)).ok());
    for (int i = 0; i < 100 && !test.failed.new_data_arrived(); ++i) {
      auto scan = test.laser.loan();
      scan->max_range(8.0);
      scan->angle_start(-std::numbers::pi / 2);
      scan->angle_increment(std::numbers::pi / 180);
      scan->ranges().assign(181, 8.0);
      for (std::size_t k = 0; k < 10; ++k) scan->ranges()[k] = 0.1;
      scan->stamp(to_time_value(test.now()));
      test.laser.push(std::move(scan));
      auto odometry = test.odometry.loan();
      odometry->stamp(to_time_value(test.now()));
      test.odometry.push(std::move(odometry));
      test.sleep(100ms);
    }
    reason = test.failed.get_update_wait()->reason();
  });
  CHECK_THAT(reason,
             Catch::Contains(
                 "blocked: no nearer than 4 m to the goal for 5 s, and of the laser \"test\" 10 of its 181 "
                 "beams, from -90 to -81 deg, end within the robot's own outline"));
}

TEST_CASE("by odometry that does not say how wrong it is Goto claims no arrival after 40 m",
          "[testing][goto]") {
  const auto arrives = [](double variance) {
    bool arrived = false;
    try_component<OdometryPorts>({.type = "orca.Goto"}, [&](OdometryPorts& test) {
      auto goal = make_object<idl::GoalPoint>();
      goal->reach_radius().distance(0.3);
      goal->coordinate().point().x(40.0);
      REQUIRE(test.goal.send(std::move(goal)).ok());
      for (int i = 0; i <= 450; ++i) {
        auto here = test.odometry.loan();
        here->x(std::min(40.0, 0.1 * i));
        here->covariance()[0] = here->covariance()[4] = variance;
        here->stamp(to_time_value(test.now()));
        test.odometry.push(std::move(here));
        test.sleep(50ms);
      }
      arrived = test.arrived.new_data_arrived();
    });
    return arrived;
  };
  CHECK(arrives(0.01));
  CHECK_FALSE(arrives(0.0));
}

TEST_CASE("Goto shows the way that is left when it changes, and not in every lap", "[testing][goto]") {
  std::vector<std::size_t> poses;
  try_component<GotoPorts>({.type = "orca.Goto"}, [&](GotoPorts& test) {
    const auto lap = [&](double x) {
      push_pose(test, x);
      test.sleep(50ms);
      while (test.path.new_data_arrived()) poses.push_back(test.path.get_update()->poses().size());
    };
    lap(0.0);
    send_goal(test, 2.0);
    for (int i = 0; i < 3; ++i) lap(0.1 * i);
    for (int i = 0; i < 100 && !test.arrived.new_data_arrived(); ++i) lap(1.9);
    lap(1.9);
  });
  CHECK(poses == std::vector<std::size_t>{0, 2, 0});
}

TEST_CASE("time is virtual, and the limit of a trial counts in it", "[testing]") {
  Duration waited{0};
  try_component<AvoidPorts>({.type = "orca.Avoid", .plugins = kTestPlugins, .limit = 3700s},
                            [&](AvoidPorts& test) {
                              const TimePoint start = test.now();
                              test.sleep(3600s);
                              waited = test.now() - start;
                            });
  CHECK(waited == 3600s);
  CHECK_THROWS_WITH(
      try_component<AvoidPorts>({.type = "orca.Avoid", .plugins = kTestPlugins, .limit = 2s},
                                [](AvoidPorts& test) { static_cast<void>(test.motion.get_update_wait()); }),
      Contains("orca.Avoid: the script did not return within 2 s of virtual time"));
}

TEST_CASE("what the script throws comes out of the trial", "[testing]") {
  CHECK_THROWS_WITH(
      try_component<AvoidPorts>(kAvoid, [](AvoidPorts& /*test*/) { throw std::runtime_error("oh"); }), "oh");
}

TEST_CASE("what the checker of graphs refuses stops a trial before it begins", "[testing]") {
  CHECK_THROWS_WITH(try_for_nothing<WrongType>(kAvoid), Contains("orca.Avoid cannot be tried") &&
                                                            Contains("RobotPose") &&
                                                            Contains("RangeReadings"));
  CHECK_THROWS_WITH(try_for_nothing<NoSuchPort>(kAvoid), Contains("ranges") && Contains("did you mean"));
  CHECK_THROWS_WITH(
      try_for_nothing<AvoidPorts>(
          {.type = "orca.Avoid", .params = {{"stop_distance", "-1 m"}}, .plugins = kTestPlugins}),
      Contains("stop_distance"));
  CHECK_THROWS_WITH(try_for_nothing<AvoidPorts>({.type = "orca.Avoyd", .plugins = kTestPlugins}),
                    Contains("orca.Avoyd"));
}

TEST_CASE("a component that fails fails its trial, with its reason", "[testing]") {
  struct NoPorts final : Partner {
    using Partner::Partner;
  };
  const Trial throws{.type = "test.Misbehaving", .params = {{"where", "configure"}}, .plugins = kTestPlugins};
  CHECK_THROWS_WITH(try_for_nothing<NoPorts>(throws), Contains("configure() threw"));
}

TEST_CASE("a trial exchanges the component for another object of its code, which goes on", "[testing]") {
  bool drove = false;
  try_component<GotoPorts>({.type = "orca.Goto", .swap_at = 200ms}, [&](GotoPorts& test) {
    send_goal(test, 2.0);
    push_pose(test, 0.0);
    test.sleep(500ms);
    (void)test.motion.get_update();
    push_pose(test, 1.0);
    drove = test.motion.get_update_wait()->kind() == idl::NORMAL;
  });
  CHECK(drove);
}
