// SPDX-License-Identifier: GPL-3.0-or-later
// Where drivers of lasers take the place of their laser from, and what is said if the robot's file does not tell it.
#include "orca/hw/laser_mount.hpp"

#include <catch2/catch.hpp>

#include "param_desk.hpp"

using namespace orca;
using namespace orca::test;
using hw::LaserMount;
using Texts = std::vector<std::string>;

namespace {

using MountDesk = ParamDesk<LaserMount>;

}  // namespace

TEST_CASE("without a robot file a laser sits where the graph says", "[hw][driver][robot_file]") {
  MountDesk desk(LaserMount::Ahead::middle_beam);
  CHECK(desk.part.read().empty());
  CHECK(desk.part.pose() == Pose2{});
  CHECK(desk.part.name() == "laser");
  desk.with("x", 0.1).with("y", -0.2).with("z", 0.3).with("yaw", 1.0).with("name", "front");
  CHECK(desk.part.read().empty());
  CHECK(desk.part.pose() == Pose2{0.1, -0.2, 1.0});
  CHECK(desk.part.height() == 0.3);
  CHECK(desk.part.name() == "front");
}

TEST_CASE("with a robot file a laser sits where the file says, and has its name there",
          "[hw][driver][robot_file]") {
  const TempFolder folder;
  MountDesk desk(LaserMount::Ahead::middle_beam);
  desk.with("robot", folder.write("r.urdf", robot_text(laser_text("eye", "deck"))));
  CHECK(texts_of(desk.part.read()) == Texts{});
  CHECK(desk.part.pose().x == Approx(0.1));
  CHECK(desk.part.pose().y == Approx(-0.02));
  CHECK(desk.part.pose().yaw == Approx(1.5));
  CHECK(desk.part.height() == Approx(0.3));
  CHECK(desk.part.name() == "eye");
}

TEST_CASE("a place that the graph sets counts more than the robot file", "[hw][driver][robot_file]") {
  const TempFolder folder;
  MountDesk desk(LaserMount::Ahead::middle_beam);
  desk.with("robot", folder.write("r.urdf", robot_text(laser_text("eye", "deck"))));
  desk.with("x", 0.0).with("z", 0.4);
  CHECK(texts_of(desk.part.read()) == Texts{});
  CHECK(desk.part.pose().x == 0.0);
  CHECK(desk.part.pose().y == Approx(-0.02));
  CHECK(desk.part.height() == 0.4);
}

TEST_CASE("a fan of beams looks where the middle of the file's fan does, a full turn as its link does",
          "[hw][driver][robot_file]") {
  const TempFolder folder;
  const std::string file = folder.write("r.urdf", robot_text(laser_text("eye", "lid", "0 deg")));
  MountDesk fan(LaserMount::Ahead::middle_beam);
  fan.with("robot", file);
  CHECK(texts_of(fan.part.read()) == Texts{});
  CHECK(fan.part.pose().yaw == Approx(0.5 * std::numbers::pi));
  MountDesk turn(LaserMount::Ahead::angle_0);
  turn.with("robot", file);
  CHECK(texts_of(turn.part.read()) == Texts{});
  CHECK(turn.part.pose().yaw == Approx(0.0).margin(1e-12));
}

TEST_CASE("of several lasers the parameter mount names one", "[hw][driver][robot_file]") {
  const TempFolder folder;
  const std::string file =
      folder.write("r.urdf", robot_text(laser_text("front", "deck") + laser_text("rear", "lid")));
  MountDesk desk(LaserMount::Ahead::middle_beam);
  desk.with("robot", file);
  CHECK(texts_of(desk.part.read()) == Texts{"robot: the robot of \"" + file +
                                            "\" has several lasers: front, rear; say by the parameter mount "
                                            "which of them this is"});
  desk.with("mount", "raer");
  CHECK(texts_of(desk.part.read()) == Texts{"mount: \"raer\" is no laser of \"" + file +
                                            "\"; lasers: front, rear; did you mean \"rear\"?"});
  desk.with("mount", "rear");
  CHECK(texts_of(desk.part.read()) == Texts{});
  CHECK(desk.part.pose().x == Approx(-0.1));
  CHECK(desk.part.height() == Approx(0.5));
  CHECK(desk.part.name() == "rear");
}

TEST_CASE("a robot file without a laser, and a laser of no file, are faults", "[hw][driver][robot_file]") {
  const TempFolder folder;
  const std::string file = folder.write("r.urdf", robot_text(""));
  MountDesk desk(LaserMount::Ahead::middle_beam);
  desk.with("robot", file);
  CHECK(texts_of(desk.part.read()) == Texts{"robot: the robot of \"" + file +
                                            "\" has no laser; add a <laser> to the file, or leave robot out "
                                            "and set x, y, z and yaw"});
  MountDesk alone(LaserMount::Ahead::middle_beam);
  alone.with("mount", "rear");
  CHECK(texts_of(alone.part.read()) ==
        Texts{"mount: \"rear\" is a laser of the robot's file, and no file is named; set robot"});
}

TEST_CASE("a laser on a turret is right only while the turret points ahead", "[hw][driver][robot_file]") {
  const TempFolder folder;
  std::string text = robot_text(
      "<turret joint=\"k\" max_speed=\"1 rad/s\" max_acceleration=\"1 rad/s2\" "
      "period=\"50 ms\"/>\n" +
      laser_text("eye", "lid"));
  const std::string fixed = "name=\"k\" type=\"fixed\"";
  text.replace(text.find(fixed), fixed.size(), "name=\"k\" type=\"continuous\"");
  const std::string lid = "<child link=\"lid\"/>";
  text.replace(text.find(lid), lid.size(), lid + "<axis xyz=\"0 0 1\"/>");
  const std::string file = folder.write("r.urdf", text);
  MountDesk desk(LaserMount::Ahead::middle_beam);
  desk.with("robot", file);
  CHECK(texts_of(desk.part.read()) ==
        Texts{"warning robot: the laser \"eye\" of \"" + file +
              "\" sits on the turret, whose angle this driver does not know; its scans are right only while "
              "the turret points ahead"});
}
