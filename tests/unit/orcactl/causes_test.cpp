// SPDX-License-Identifier: GPL-3.0-or-later
#include "tapping/causes.hpp"

#include <catch2/catch.hpp>

#include "tapping/following.hpp"

using namespace orca::orcactl;

TEST_CASE("an object is followed back to the reading that it began with, by port and number", "[orcactl]") {
  Causes causes;
  causes.note_beginning({"base.OdometryPush", 7}, 1'000);
  causes.note({"base.SonarRangeReadingsPush", 7}, {});  // another port of the same component
  causes.note({"avoid.motion", 3}, {"base.OdometryPush", 7});
  causes.note({"fuser.base", 9}, {"avoid.motion", 3});
  const Causes::Way way = causes.way_to({"fuser.base", 9});
  CHECK(way.sensed == 1'000);
  CHECK(way.text() == "base.OdometryPush > avoid.motion > fuser.base");
}

TEST_CASE("a way that begins elsewhere, or that was not seen to its end, has no beginning", "[orcactl]") {
  Causes causes;
  causes.note_beginning({"base.OdometryPush", 7}, 1'000);
  causes.note({"command.goto", 1}, {});
  causes.note({"goto.motion", 1}, {"command.goto", 1});
  causes.note({"goto.motion", 2}, {"localizer.RobotPosePush", 5});
  CHECK_FALSE(causes.way_to({"goto.motion", 1}).sensed);
  CHECK(causes.way_to({"goto.motion", 1}).text() == "command.goto > goto.motion");
  CHECK_FALSE(causes.way_to({"goto.motion", 2}).sensed);
  CHECK(causes.way_to({"goto.motion", 2}).text() == "? > goto.motion");
}

TEST_CASE("causes that go round in a circle end, and old objects are forgotten", "[orcactl]") {
  Causes causes;
  causes.note({"a.out", 1}, {"b.out", 1});
  causes.note({"b.out", 1}, {"a.out", 1});
  CHECK_FALSE(causes.way_to({"a.out", 1}).sensed);
  for (std::uint64_t seq = 1; seq <= Causes::kMostObjects; ++seq) causes.note_beginning({"c.out", seq}, seq);
  CHECK_FALSE(causes.way_to({"a.out", 1}).complete);
  CHECK(causes.way_to({"c.out", 1}).sensed == 1);
}

TEST_CASE("--from and --to take a port by its name, by its short name, and the wheels", "[orcactl]") {
  const std::set<std::string> ports{"base.MotionCommandSend", "base.OdometryPush", "avoid.odometry"};
  const auto meant = [&](const std::string& word) { return port_meant_by(word, ports).value(); };
  CHECK(meant("avoid.odometry") == "avoid.odometry");
  CHECK(meant("base.odometry") == "base.OdometryPush");
  CHECK(meant("base.motioncommand") == "base.MotionCommandSend");
  CHECK(meant("wheels") == "base.MotionCommandSend");
  CHECK(meant("base.lazer") == "base.lazer");  // the supervisor says which names there are
  CHECK_FALSE(port_meant_by("wheels", {"a.MotionCommandSend", "b.MotionCommandSend"}));
  CHECK_FALSE(port_meant_by("wheels", {"avoid.odometry"}));
}
