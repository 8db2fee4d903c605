// SPDX-License-Identifier: GPL-3.0-or-later
// What drivers make of a robot's file, which they read with the simulator's reader.
#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <numbers>
#include <tuple>

#include "orca/hw/base_figures.hpp"
#include "orca/hw/laser_place.hpp"
#include "orca/hw/robot_figures.hpp"
#include "orca/sim/robot_file.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;

namespace {

const std::string kRobots = std::string(ORCA_SOURCE_DIR) + "/sim/robots/";

// A driver that has only parameters, which a test sets.
struct Owner {
  std::vector<ParamDeclaration> params;
  void declare_param(ParamDeclaration declaration) { params.push_back(std::move(declaration)); }
  template <class T>
  void set(const std::string& name, T value) {
    for (ParamDeclaration& param : params)
      if (param.contract.name == name) return param.set(ParamValue(std::move(value)));
    FAIL("there is no parameter " << name);
  }
};

std::string all_of(const std::vector<HardwareFault>& faults) {
  std::string text;
  for (const HardwareFault& fault : faults) text += fault.param + ": " + fault.text + "\n";
  return text;
}

std::string faults_of(const std::string& text) {
  const TempFolder folder;
  std::vector<HardwareFault> faults;
  CHECK_FALSE(hw::read_robot_figures(folder.write("r.urdf", text), faults));
  return all_of(faults);
}

const hw::BaseFigures::Expected kPioneer{"Pioneer", idl::DIFFERENTIAL, 0.357};

// As the simulator tells it to those who plan.
Vec2 size_of(const sim::Shape& footprint) {
  if (std::holds_alternative<sim::Circle>(footprint)) return {};
  const auto [low, high] = sim::bounds_of(footprint);
  return {2.0 * std::max(-low.x, high.x), 2.0 * std::max(-low.y, high.y)};
}

bool is_corner_of(const std::vector<Vec2>& corners, Vec2 p) {
  return std::ranges::any_of(corners, [&](Vec2 corner) { return norm(corner - p) < 1e-9; });
}

// Each part is the prism over the simulator's plan of it, and as high.
void check_parts(const std::vector<robot_file::BodyPart>& parts, const std::vector<sim::Part>& expected) {
  REQUIRE(parts.size() == expected.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto [low, high] = sim::height_range_of({expected[i]});
    CHECK(parts[i].bottom == Approx(low).margin(1e-9));
    CHECK(parts[i].top == Approx(high).margin(1e-9));
    const sim::Shape plan = sim::footprint_of({expected[i]});
    if (parts[i].corners.size() == 1) {
      const auto [from, to] = sim::bounds_of(plan);
      CHECK(norm(0.5 * (from + to) - parts[i].corners[0]) < 0.01 * parts[i].radius);
      CHECK(0.5 * (to.x - from.x) ==
            Approx(parts[i].radius).epsilon(0.01));  // of its polygon, if not in the middle
      continue;
    }
    const std::vector<sim::Segment> edges = sim::edges_of(plan);
    CHECK(edges.size() == parts[i].corners.size());
    for (const sim::Segment& edge : edges) CHECK(is_corner_of(parts[i].corners, edge.a));
  }
}

// The drive of a Pioneer, with what is wrong or missing in it.
std::string drive_with(const std::string& more) {
  return "<robot name='r'>\n<orca radius='0.2 m'><drive type='differential' max_speed='1 m/s' "
         "max_steer_speed='1 rad/s' "
         "max_acceleration='1 m/s2' max_steer_acceleration='1 rad/s2' wheel_diameter='0.1 m' " +
         more + "/><odometry period='0.1 s'/></orca></robot>";
}

// Where a laser sits by the file of that text.
struct Placed {
  explicit Placed(const std::string& text) { owner.set("robot", folder.write("r.urdf", text)); }
  std::string faults() { return all_of(place.read()); }
  TempFolder folder;
  Owner owner;
  hw::LaserPlace place{owner, "its middle beam"};
};

const std::string kTwoLasers = R"(<robot name="r"><link name="base"/><link name="mast"/><link name="head"/>
  <joint name="m" type="fixed"><parent link="base"/><child link="mast"/><origin xyz="0.1 0.2 0.5" rpy="0 0 1.5"/></joint>
  <joint name="h" type="fixed"><parent link="mast"/><child link="head"/><origin xyz="0.3 0 0.25"/></joint>
  <orca radius="20 cm"><laser name="low" link="base" count="3" first_angle="-1 rad" pitch="1 rad" max_range="8 m" period="0.1 s"/>
  <laser name="high" link="head" count="3" first_angle="-1 rad" pitch="1 rad" max_range="8 m" period="0.1 s"/></orca></robot>)";

}  // namespace

TEST_CASE(
    "a shipped robot is as large for a driver as for the simulator, and its lasers sit where they do there",
    "[hw][robot_file]") {
  for (const auto& file : std::filesystem::directory_iterator(kRobots)) {
    if (file.path().extension() != ".urdf") continue;
    CAPTURE(file.path().string());
    std::vector<HardwareFault> faults;
    const auto figures = hw::read_robot_figures(file.path(), faults);
    INFO(all_of(faults));
    REQUIRE(figures);
    xml::Diagnostics diagnostics;
    const auto model = sim::read_robot(file.path(), diagnostics);
    REQUIRE(model);
    REQUIRE(figures->size);
    const Vec2 size = size_of(model->footprint);
    CHECK(figures->size->x == Approx(size.x).margin(1e-9));
    CHECK(figures->size->y == Approx(size.y).margin(1e-9));
    check_parts(figures->parts, model->parts);
    REQUIRE(figures->lasers.size() == model->lasers.size());
    for (std::size_t i = 0; i < model->lasers.size(); ++i) {
      CHECK(figures->lasers[i].center.x == Approx(model->lasers[i].center.x).margin(1e-12));
      CHECK(figures->lasers[i].center.y == Approx(model->lasers[i].center.y).margin(1e-12));
      CHECK(figures->lasers[i].center.yaw == Approx(model->lasers[i].center.yaw).margin(1e-12));
      CHECK(figures->lasers[i].height == Approx(model->lasers[i].height).margin(1e-12));
    }
  }
}

TEST_CASE("a gripper has its paddles beside the room of what it holds", "[hw][robot_file]") {
  std::vector<HardwareFault> faults;
  const auto figures = hw::read_robot_figures(kRobots + "pioneer_2dx_gripper.urdf", faults);
  REQUIRE(figures);
  REQUIRE(figures->paddles.size() == 2);
  REQUIRE(figures->load.size() == 1);
  CHECK(figures->paddles[0].top == Approx(0.05 + 0.08 + 0.05));
  const auto has = [](const robot_file::BodyPart& part, Vec2 p) { return is_corner_of(part.corners, p); };
  CHECK((has(figures->load[0], {0.211, -0.11}) && has(figures->load[0], {0.311, 0.11})));
  CHECK((has(figures->paddles[0], {0.311, 0.11}) && has(figures->paddles[0], {0.311, 0.13})));
  CHECK((has(figures->paddles[1], {0.311, -0.11}) && has(figures->paddles[1], {0.211, -0.13})));
}

TEST_CASE("without a file there are no figures, and nothing is wrong", "[hw][robot_file]") {
  std::vector<HardwareFault> faults;
  CHECK_FALSE(hw::read_robot_figures("", faults));
  CHECK(faults.empty());
}

TEST_CASE("what is wrong with a robot file is said with its place, all at once", "[hw][robot_file]") {
  CHECK_THAT(faults_of("<robot"), Contains("robot: ") && Contains("r.urdf:1:"));
  CHECK_THAT(faults_of("<robot name='r'/>"), Contains("<robot> needs the element <orca radius="));
  const std::string figures = faults_of("<robot name='r'>\n<orca>\n<drive max_speed='1 kg'/></orca></robot>");
  CHECK_THAT(figures, Contains("r.urdf:2:1: <orca> needs the attribute \"radius\""));
  CHECK_THAT(figures, Contains("r.urdf:3:19: max_speed") && Contains("1 kg"));
  CHECK_THAT(figures, Contains("<drive> needs the attribute \"track\""));
  CHECK_THAT(faults_of(drive_with("track='0 m'")), Contains("track"));
  std::string tilted = kTwoLasers;
  tilted.replace(tilted.find("0 0 1.5"), 7, "0.2 0 0");
  CHECK_THAT(faults_of(tilted), Contains("the laser \"high\" is tilted"));
  std::string short_of = kTwoLasers;
  short_of.replace(short_of.find("0.3 0 0.25"), 10, "0.3 0");
  CHECK_THAT(faults_of(short_of), Contains("xyz: \"0.3 0\" holds 2 numbers, expected 3"));
}

TEST_CASE("a base is no faster than its file and its parameters say", "[hw][robot_file]") {
  Owner owner;
  hw::BaseFigures base(owner);
  const hw::DriveLimits own{.max_speed = 0.5, .max_turn_rate = 9.0};
  CHECK(base.read(kPioneer).empty());
  CHECK(base.within(own).max_turn_rate == 9.0);
  owner.set("robot", kRobots + "pioneer_2dx.urdf");
  CHECK(base.read(kPioneer).empty());
  CHECK(base.within(own).max_speed == 0.5);  // less than the 2.2 m/s of the file
  CHECK(base.within(own).max_turn_rate == Approx(500.0 / 180.0 * 3.14159265358979));
  CHECK(base.within(0.76) == 0.5);
  idl::Robot robot;
  base.describe(robot);
  CHECK(robot.radius() == 0.309);
}

TEST_CASE("a base is steered as its file says, and tells how large it is and how wrong its senses are",
          "[hw][robot_file]") {
  Owner owner;
  hw::BaseFigures base(owner);
  const hw::DriveLimits own{.steer_gain = 0.5, .big_turn_angle = 1.5, .big_turn_speed = 0.1};
  CHECK(base.read(kPioneer).empty());
  CHECK(base.within(own).steer_gain == 0.5);
  CHECK_FALSE(base.traits().odometry);
  CHECK_FALSE(base.traits().sonars.is_known());

  owner.set("robot", kRobots + "pioneer_2dx.urdf");
  CHECK(base.read(kPioneer).empty());
  CHECK(base.within(own).steer_gain == 2.0);
  CHECK(base.within(own).big_turn_angle == Approx(1.0471975511966));
  CHECK(base.within(own).big_turn_speed == 0.3);
  idl::Robot robot;
  base.describe(robot);
  CHECK(robot.length() == Approx(0.6));  // around the axle, which is not in the middle
  CHECK(robot.width() == Approx(0.425));
  CHECK(base.traits().odometry);
  CHECK(base.traits().sonars == RangeErrorGuess{0.01, 0.01});
}

TEST_CASE("a file that does not say how wrong the wheels are is a warning, and the usual errors are taken",
          "[hw][robot_file]") {
  const TempFolder folder;
  Owner owner;
  hw::BaseFigures base(owner);
  owner.set("robot", folder.write("r.urdf", drive_with("track='0.357 m' steer_gain='2'")));
  const auto faults = base.read(kPioneer);
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].only_warns);
  CHECK_THAT(faults[0].text,
             Contains("the file says no wheel_errors of this robot; the usual ones are taken"));
  CHECK(base.traits().odometry);
  CHECK(base.within(hw::DriveLimits{}).steer_gain == 2.0);
}

TEST_CASE("the file of quite another robot is a warning", "[hw][robot_file]") {
  Owner owner;
  hw::BaseFigures base(owner);
  owner.set("robot", kRobots + "create2.urdf");
  const auto faults = base.read(kPioneer);
  REQUIRE(faults.size() == 1);
  CHECK(faults[0].only_warns);
  CHECK_THAT(faults[0].text, Contains("has a track of 0.235 m, and a Pioneer has one of about 0.357 m"));
  owner.set("robot", kRobots + "nomad_scout.urdf");
  CHECK(base.read(kPioneer).empty());  // a Scout's is nearly the same
}

TEST_CASE("bumpers of several rings are one list", "[hw][robot_file]") {
  const TempFolder folder;
  std::vector<HardwareFault> faults;
  const auto figures = hw::read_robot_figures(
      folder.write(
          "r.urdf",
          "<robot name='r'>\n<orca radius='0.2 m'>"
          "<bumper_ring name='f' count='2' first_angle='-45 deg' pitch='90 deg' period='0.1 s'/>"
          "<bumper_ring name='r' count='1' angles='180 deg' pitch='90 deg' period='0.1 s'/></orca></robot>"),
      faults);
  INFO(all_of(faults));
  REQUIRE(figures);
  const std::vector<double> bumpers = figures->bumper_directions();
  REQUIRE(bumpers.size() == 3);
  CHECK(bumpers[0] == Approx(-0.25 * std::numbers::pi));
  CHECK(bumpers[1] == Approx(0.25 * std::numbers::pi));
  CHECK(std::abs(bumpers[2]) == Approx(std::numbers::pi));
}

TEST_CASE("a box on the deck of a round robot makes it larger than round", "[hw][robot_file]") {
  const std::string round =
      R"(<robot name="r"><link name="base"><collision><geometry><cylinder radius="0.2" length="0.1"/></geometry></collision>
    </link><link name="deck"/><joint name="j" type="fixed"><parent link="base"/><child link="deck"/><origin xyz="0.1 0 0.2" rpy="0 0 1.5707963267948966"/></joint>
    <orca radius="20 cm"><laser name="l" link="base" count="3" first_angle="-1 rad" pitch="1 rad" max_range="8 m" period="0.1 s"/></orca></robot>)";
  const auto size_with = [&](const std::string& on_deck) {
    const TempFolder folder;
    std::string text = round;
    text.replace(text.find(R"(<link name="deck"/>)"), 19,
                 R"(<link name="deck"><collision><geometry>)" + on_deck + "</geometry></collision></link>");
    std::vector<HardwareFault> faults;
    const auto figures = hw::read_robot_figures(folder.write("r.urdf", text), faults);
    INFO(all_of(faults));
    REQUIRE(figures);
    return figures->size;
  };
  CHECK(size_with(R"(<box size="0.1 0.05 0.1"/>)") == Vec2{});
  const auto larger = size_with(R"(<box size="0.6 0.4 0.1"/>)");
  REQUIRE(larger);
  CHECK(larger->x == Approx(0.6));  // 0.1 m ahead of the middle, and turned: half of 0.4 m
  CHECK(larger->y == Approx(0.6));
  CHECK_FALSE(size_with(R"(<mesh filename="box.stl"/>)"));
}

TEST_CASE("the file of a robot that drives otherwise, or not at all, is refused", "[hw][robot_file]") {
  Owner owner;
  hw::BaseFigures base(owner);
  owner.set("robot", kRobots + "omni.urdf");
  CHECK_THAT(
      all_of(base.read(kPioneer)),
      Contains("the file of a robot whose drive is holonomic, and the drive of this one is differential"));
  owner.set("robot", std::string(ORCA_SOURCE_DIR) + "/sim/fixtures/scanner_post.urdf");
  CHECK_THAT(all_of(base.read(kPioneer)), Contains("has no <drive>"));
  owner.set("robot", kRobots + "nobody.urdf");
  CHECK_THAT(all_of(base.read(kPioneer)), Contains("nobody.urdf"));
}

TEST_CASE("drivers and the simulator leave out the same readings of the robot itself, also upside down",
          "[hw][robot_file]") {
  const TempFolder folder;
  const std::string text = read_text(std::string(ORCA_SOURCE_DIR) + "/sim/fixtures/pioneer_2dx_deck.urdf");
  const std::string upright = R"(<origin xyz="0.017 0.008 0.3"/>)";
  REQUIRE(text.find(upright) != std::string::npos);
  std::string hanging = text;
  hanging.replace(hanging.find(upright), upright.size(),
                  R"(<origin xyz="0.017 0.008 0.3" rpy="3.141592653589793 0 0"/>)");
  const auto ignored = [&](const std::string& robot, int degrees) {
    xml::Diagnostics diagnostics;
    const std::string file = folder.write("r.urdf", robot);
    const auto model = sim::read_robot(file, diagnostics);
    REQUIRE(model);
    Owner owner;
    hw::LaserPlace place(owner, "its middle beam");
    owner.set("robot", file);
    REQUIRE(place.read().empty());
    const double angle = degrees * std::numbers::pi / 180.0;
    CHECK(place.ignores(angle) == model->lasers[0].ignores(angle));
    return place.ignores(angle);
  };
  for (const auto& [degrees, of_upright, of_hanging] : {std::tuple{50, false, false},
                                                        {51, true, false},
                                                        {60, true, true},
                                                        {69, true, true},
                                                        {70, false, true},
                                                        {71, false, false},
                                                        {-51, false, true},
                                                        {-54, true, true},
                                                        {-70, true, false},
                                                        {0, false, false}}) {
    INFO(degrees);
    CHECK(ignored(text, degrees) == of_upright);
    CHECK(ignored(hanging, degrees) == of_hanging);
  }
}

TEST_CASE("a laser that hangs upside down measures in the other sense, for drivers and in the simulator",
          "[hw][robot_file]") {
  const TempFolder folder;
  std::string text = read_text(kRobots + "pioneer_2dx.urdf");
  const std::string upright = R"(<origin xyz="0.017 0.008 0.3"/>)";
  REQUIRE(text.find(upright) != std::string::npos);
  text.replace(text.find(upright), upright.size(),
               R"(<origin xyz="0.017 0.008 0.3" rpy="3.141592653589793 0 0.5"/>)");
  const std::string file = folder.write("hanging.urdf", text);
  xml::Diagnostics diagnostics;
  const auto model = sim::read_robot(file, diagnostics);
  REQUIRE(model);
  CHECK(model->lasers[0].upside_down);
  CHECK(model->lasers[0].first_angle == Approx(0.5 * std::numbers::pi));
  CHECK(model->lasers[0].pitch == Approx(-std::numbers::pi / 180.0));
  CHECK(model->lasers[0].center.yaw == Approx(0.5));
  Owner owner;
  hw::LaserPlace place(owner, "its middle beam");
  owner.set("robot", file);
  REQUIRE(place.read().empty());
  CHECK(place.sense() == -1.0);
  CHECK(place.place().yaw == Approx(0.5));
  owner.set("upside_down", true);
  CHECK_THAT(all_of(place.read()), Contains("leave these away, or the file"));
  owner.set("robot", std::string());
  REQUIRE(place.read().empty());
  CHECK(place.sense() == -1.0);
}

TEST_CASE("a byte order mark, instructions and dashes in comments hinder a driver as little as the simulator",
          "[hw][robot_file]") {
  const TempFolder folder;
  const std::string file = folder.write(
      "foreign.urdf",
      "\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<?xml-model href=\"urdf.xsd\"?>\n<!-- -- two -- -->\n" +
          std::string(kTwoLasers));
  std::vector<HardwareFault> faults;
  CHECK(hw::read_robot_figures(file, faults));
  CHECK(all_of(faults).empty());
}

TEST_CASE("a laser sits where the robot's file says, through all joints", "[hw][robot_file]") {
  Placed laser(kTwoLasers);
  laser.owner.set("mount", std::string("high"));
  CHECK(laser.faults().empty());
  CHECK(laser.place.place().x == Approx(0.1 + 0.3 * std::cos(1.5)));
  CHECK(laser.place.place().y == Approx(0.2 + 0.3 * std::sin(1.5)));
  CHECK(laser.place.place().yaw == Approx(1.5));
  CHECK(laser.place.height() == Approx(0.75));
}

TEST_CASE("a laser whose place is not clear is refused with what to do", "[hw][robot_file]") {
  Placed laser(kTwoLasers);
  CHECK_THAT(laser.faults(), Contains("mount: the robot's file has several lasers; name one of low, high"));
  laser.owner.set("mount", std::string("middle"));
  CHECK_THAT(laser.faults(), Contains("has no laser \"middle\"; lasers: low, high"));
  laser.owner.set("mount", std::string("low"));
  laser.owner.set("z", 0.3);
  CHECK_THAT(laser.faults(), Contains("and so do x, y, z, yaw or upside_down; leave these away"));
  Placed blind(drive_with("track='0.3 m'"));
  CHECK_THAT(blind.faults(), Contains("has no laser; leave it away, and set x, y, z and yaw"));
  Owner owner;
  hw::LaserPlace place(owner, "its middle beam");
  owner.set("mount", std::string("low"));
  CHECK_THAT(all_of(place.read()),
             Contains("mount: it names a laser of the robot's file, and there is none"));
}

TEST_CASE("a robot's file that describes the robot twice is refused where it begins anew",
          "[hw][robot_file]") {
  const TempFolder folder;
  const std::string file =
      folder.write("two.urdf",
                   "<robot name=\"r\">\n  <link name=\"l\"/>\n  <orca radius=\"20 cm\"/>\n"
                   "  <orca radius=\"30 cm\"/>\n</robot>\n");
  std::vector<HardwareFault> faults;
  CHECK_FALSE(hw::read_robot_figures(file, faults));
  CHECK_THAT(all_of(faults), Contains("4:3: there is an <orca> already; a robot has one"));
}
