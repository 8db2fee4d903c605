// SPDX-License-Identifier: GPL-3.0-or-later
// What drivers of bases take from the robot's file, what the graph takes back, and what is said about a file that does not fit.
#include "orca/hw/base_params.hpp"

#include <catch2/catch.hpp>

#include "param_desk.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using hw::BaseParams;
using hw::OwnFigures;
using Texts = std::vector<std::string>;

namespace {

using BaseDesk = ParamDesk<BaseParams>;

const std::string kShipped = ORCA_SOURCE_DIR "/sim/robots/";

OwnFigures usual() { return {.name = "Own", .most_speed = 1.0, .most_turn_rate = 3.0}; }

struct Range {
  std::optional<double> min{};
  std::optional<double> max{};
};

// A driver's extra parameter, beside those of every base.
struct WithAcceleration {
  explicit WithAcceleration(hw::HardwareContainer& owner, Range range = {})
      : base(owner, usual()),
        acceleration(owner, "max_acceleration", 0.3, {.unit = "m/s2", .min = range.min, .max = range.max}) {}

  std::vector<HardwareFault> read() {
    std::vector<HardwareFault> faults = base.read();
    for (HardwareFault& fault : base.give(acceleration, &robots::Drive::max_acceleration, "max_acceleration"))
      faults.push_back(std::move(fault));
    return faults;
  }

  BaseParams base;
  hw::FileParam<double> acceleration;
};

}  // namespace

TEST_CASE("without a robot file a base has its driver's own figures, and those of the graph",
          "[hw][driver][robot_file]") {
  BaseDesk desk(usual());
  desk.with("max_speed", 0.7);
  CHECK(desk.part.read().empty());
  const hw::DriveLimits limits = desk.part.limits();
  CHECK(limits.max_speed == 0.7);
  CHECK(limits.max_turn_rate == 1.5);
  CHECK(limits.steer_gain == 0.5);
  CHECK(limits.big_turn_angle == 1.0);
  CHECK(limits.big_turn_speed == 0.1);
  CHECK(desk.part.name() == "Own");
  CHECK(desk.part.sonars() == 0);
}

TEST_CASE("with a robot file a base has the limits, the steering and the name of its drive",
          "[hw][driver][robot_file]") {
  const TempFolder folder;
  BaseDesk desk(usual());
  desk.with("robot", folder.write("r.urdf", robot_text("")));
  CHECK(texts_of(desk.part.read()) == Texts{});
  const hw::DriveLimits limits = desk.part.limits();
  CHECK(limits.max_speed == 0.8);
  CHECK(limits.max_turn_rate == 2.0);
  CHECK(limits.steer_gain == 1.5);
  CHECK(limits.big_turn_angle == 0.7);
  CHECK(limits.big_turn_speed == 0.25);
  CHECK(limits.type == idl::DIFFERENTIAL);
  CHECK(desk.part.name() == "Rover");
}

TEST_CASE("what the graph sets counts more than the robot file, even if it is the driver's own figure",
          "[hw][driver][robot_file]") {
  const TempFolder folder;
  BaseDesk desk(usual());
  desk.with("robot", folder.write("r.urdf", robot_text("")));
  desk.with("max_speed", 0.5).with("name", "Dewey").with("steer_gain", 0.5);
  CHECK(texts_of(desk.part.read()) == Texts{});
  CHECK(desk.part.limits().max_speed == 0.5);
  CHECK(desk.part.limits().steer_gain == 0.5);
  CHECK(desk.part.limits().max_turn_rate == 2.0);
  CHECK(desk.part.name() == "Dewey");
}

TEST_CASE("a driver may take further figures of the drive", "[hw][driver][robot_file]") {
  const TempFolder folder;
  const std::string file = folder.write("r.urdf", robot_text(""));
  ParamDesk<WithAcceleration> desk;
  CHECK(desk.part.read().empty());
  CHECK(*desk.part.acceleration == 0.3);
  desk.with("robot", file);
  CHECK(texts_of(desk.part.read()) == Texts{});
  CHECK(*desk.part.acceleration == 0.6);
  desk.with("max_acceleration", 0.1);
  CHECK(texts_of(desk.part.read()) == Texts{});
  CHECK(*desk.part.acceleration == 0.1);
}

TEST_CASE("a figure beyond what the device can take counts as the nearest that it can, with a warning",
          "[hw][driver][robot_file]") {
  const TempFolder folder;
  const std::string file = folder.write("r.urdf", robot_text(""));
  BaseDesk desk(OwnFigures{.name = "Own", .most_speed = 0.5, .most_turn_rate = 3.0});
  desk.with("robot", file);
  CHECK(texts_of(desk.part.read()) ==
        Texts{"warning robot: max_speed of the <drive> in \"" + file +
              "\" is 0.8 m/s, but this device can take at most 0.5 m/s, so it counts as 0.5 m/s; correct the "
              "file, or set max_speed"});
  CHECK(desk.part.limits().max_speed == 0.5);
  ParamDesk<WithAcceleration> slow(Range{.min = 0.05, .max = 0.4});
  slow.with("robot", file);
  CHECK(
      texts_of(slow.part.read()) ==
      Texts{"warning robot: max_acceleration of the <drive> in \"" + file +
            "\" is 0.6 m/s2, but this device can take from 0.05 m/s2 to 0.4 m/s2, so it counts as 0.4 m/s2; "
            "correct the file, or set max_acceleration"});
  ParamDesk<WithAcceleration> fast(Range{.min = 0.7});
  fast.with("robot", file);
  CHECK(texts_of(fast.part.read()) ==
        Texts{"warning robot: max_acceleration of the <drive> in \"" + file +
              "\" is 0.6 m/s2, but this device can take at least 0.7 m/s2, so it counts as 0.7 m/s2; correct "
              "the file, or set max_acceleration"});
}

TEST_CASE("no warning about a figure that the graph overrules, or that misses the limit by rounding",
          "[hw][driver][robot_file]") {
  const TempFolder folder;
  const std::string file = folder.write("r.urdf", robot_text(""));
  BaseDesk overruled(OwnFigures{.name = "Own", .most_speed = 0.5, .most_turn_rate = 3.0});
  overruled.with("robot", file).with("max_speed", 0.4);
  CHECK(texts_of(overruled.part.read()) == Texts{});
  CHECK(overruled.part.limits().max_speed == 0.4);
  BaseDesk rounded(OwnFigures{.name = "Own", .most_speed = 0.79999, .most_turn_rate = 3.0});
  rounded.with("robot", file);
  CHECK(texts_of(rounded.part.read()) == Texts{});
  CHECK(rounded.part.limits().max_speed == 0.79999);
}

TEST_CASE("one robot of a driver may take less than another, whoever asks", "[hw][driver][robot_file]") {
  const TempFolder folder;
  const std::string file = folder.write("r.urdf", robot_text(""));
  BaseDesk desk(OwnFigures{.name = "Own"});
  desk.part.limit(0.6, 0.0);
  desk.with("robot", file);
  CHECK_THAT(texts_of(desk.part.read()).at(0), Contains("this device can take at most 0.6 m/s"));
  CHECK(desk.part.limits().max_speed == 0.6);
  CHECK(desk.part.limits().max_turn_rate == 2.0);
  desk.with("max_speed", 5.0);
  CHECK(texts_of(desk.part.read()) == Texts{});
  CHECK(desk.part.limits().max_speed == 0.6);
}

TEST_CASE("a robot file with another kind of drive is refused", "[hw][driver][robot_file]") {
  const TempFolder folder;
  const std::string file = folder.write("r.urdf", robot_text("", "holonomic"));
  BaseDesk desk(usual());
  desk.with("robot", file);
  CHECK(texts_of(desk.part.read()) ==
        Texts{"robot: the robot of \"" + file +
              "\" has a drive of type holonomic, and this driver drives a differential one; name the file of "
              "the robot that is at this line"});
}

TEST_CASE("a track that no robot of the driver has is doubted", "[hw][driver][robot_file]") {
  const TempFolder folder;
  const std::string file = folder.write("r.urdf", robot_text(""));
  OwnFigures own = usual();
  own.fixed_track = 0.235;
  BaseDesk desk(own);
  desk.with("robot", file);
  CHECK(texts_of(desk.part.read()) ==
        Texts{"warning robot: track of the <drive> in \"" + file +
              "\" is 0.33 m, but this driver computes with 0.235 m, which all its robots have; correct the "
              "file, or name that of the robot at this line"});
  desk.with("robot", kShipped + "create2.urdf");
  for (const std::string& text : texts_of(desk.part.read())) CHECK_THAT(text, !Contains("track"));
}

TEST_CASE("a number of sonars that no robot of the driver has is doubted, but not a file without sonars",
          "[hw][driver][robot_file]") {
  OwnFigures own = usual();
  own.sonars = 16;
  BaseDesk desk(own);
  desk.with("robot", kShipped + "peoplebot.urdf");
  CHECK(
      texts_of(desk.part.read()) ==
      Texts{
          "warning robot: the robot of \"" + kShipped +
          "peoplebot.urdf\" has 24 sonars, and each robot of this driver has 16; name the file of the robot "
          "that is at this line"});
  for (const char* const robot : {"nomad_scout.urdf", "create2.urdf"}) {
    desk.with("robot", kShipped + robot);
    for (const std::string& text : texts_of(desk.part.read())) CHECK_THAT(text, !Contains("sonars"));
  }
}

TEST_CASE("a missing robot file is a fault of the parameter, an error in it has its place",
          "[hw][driver][robot_file]") {
  const TempFolder folder;
  BaseDesk desk(usual());
  desk.with("robot", folder.file("none.urdf"));
  const Texts missing = texts_of(desk.part.read());
  REQUIRE(missing.size() == 1);
  CHECK_THAT(missing[0], Catch::StartsWith("robot: \"" + folder.file("none.urdf") + "\": "));
  const std::string file = folder.write("r.urdf", robot_text("<odometry/>\n"));
  desk.with("robot", file);
  const Texts broken = texts_of(desk.part.read());
  REQUIRE(broken.size() == 1);
  CHECK_THAT(broken[0], Catch::StartsWith(": " + file + ":5:1: error R004: "));
  CHECK(desk.part.limits().max_speed == 0.5);
}

TEST_CASE("a description is completed by what only the robot file knows", "[hw][driver][robot_file]") {
  const TempFolder folder;
  const std::string ring =
      "<sonar_ring name=\"sonar\" link=\"base\" count=\"4\" pitch=\"90 deg\" half_lobe=\"0.2 rad\" "
      "min_range=\"0.1 m\" max_range=\"5 m\" period=\"0.2 s\" radius=\"0.15 m\" vendor=\"Polaroid\"/>\n";
  BaseDesk desk(usual());
  desk.with("robot", folder.write("r.urdf", robot_text(ring)));
  CHECK(texts_of(desk.part.read()) == Texts{});
  CHECK(desk.part.sonars() == 4);
  idl::Robot robot;
  robot.name("Rover");
  robot.vendor("Driver's");
  robot.drives().emplace_back();
  robot.sonar_rings().emplace_back();
  robot.sonar_rings()[0].number(4);
  robot.sonar_rings()[0].half_lobe(0.1);
  desk.part.complete(robot);
  CHECK(robot.name() == "Rover");
  CHECK(robot.vendor() == "Makers");
  CHECK(robot.model() == "R1");
  CHECK(robot.radius() == 0.2);
  CHECK(robot.bumper_radius() == 0.22);
  CHECK(robot.drives()[0].vendor() == "Wheelers");
  CHECK(robot.drives()[0].speed_change() == 0.6);
  CHECK(robot.sonar_rings()[0].vendor() == "Polaroid");
  CHECK(robot.sonar_rings()[0].radius() == 0.15);
  CHECK(robot.sonar_rings()[0].half_lobe() == 0.1);  // The driver knows that.
}
