// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "angles.hpp"
#include "orca/sim/robot_file.hpp"

using namespace orca::sim;
using orca::Pose2;
using orca::sim::test::kDegree;

namespace {

const std::string kInertial = R"(<inertial><mass value="10"/>)"
                              R"(<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="0.5"/></inertial>)";
const std::string kCollision = R"(<collision><origin xyz="0 0 0.2"/>)"
                               R"(<geometry><cylinder radius="0.2" length="0.3"/></geometry></collision>)";
const std::string kBase = R"(<link name="base">)" + kInertial + kCollision + "</link>";
const std::string kDrive =
    R"(<drive type="differential" max_speed="1 m/s" max_steer_speed="2 rad/s" max_acceleration="1 m/s2")"
    R"( max_steer_acceleration="4 rad/s2" track="0.35 m" wheel_diameter="0.15 m"/>)";
const std::string kRing =
    R"(<sonar_ring name="sonar" link="base" count="4" pitch="90 deg" half_lobe="10 deg" min_range="0.1 m")"
    R"( max_range="5 m" period="0.2 s"/>)";

std::string robot(const std::string& links, const std::string& devices = kDrive) {
  return "<robot name=\"r\">\n" + links + "\n<orca radius=\"0.2 m\">" + devices + "</orca>\n</robot>\n";
}

std::optional<RobotModel> read(const std::string& text, std::string& errors) {
  orca::xml::Diagnostics diagnostics;
  auto model = read_robot_text(text, "r.urdf", diagnostics);
  errors = diagnostics.text();
  return model;
}

std::string errors_of_robot(const std::string& text) {
  std::string errors;
  CHECK_FALSE(read(text, errors).has_value());
  return errors;
}

// Errors of the base with one more part, at line 3.
std::string errors_with(const std::string& more) { return errors_of_robot(robot(kBase + "\n" + more)); }

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

std::string joint(const std::string& name, const std::string& parent, const std::string& child) {
  return "<joint name='" + name + "' type='fixed'><parent link='" + parent + "'/><child link='" + child +
         "'/></joint>";
}

}  // namespace

TEST_CASE("the shipped scout has the dimensions of a Nomad Scout", "[sim][robot_file]") {
  orca::xml::Diagnostics diagnostics;
  const auto scout = read_robot(ORCA_SOURCE_DIR "/sim/robots/nomad_scout.urdf", diagnostics);
  INFO(diagnostics.text());
  REQUIRE(scout);
  CHECK(scout->vendor == "Nomadics");
  CHECK(scout->radius == 0.19);
  CHECK(scout->bumper_radius == 0.205);
  CHECK(std::get<Circle>(scout->footprint).radius == Approx(0.205));
  CHECK(scout->drive.max_speed == 1.0);
  CHECK(scout->drive.max_acceleration == 0.76);
  CHECK(scout->mass == 23.0);
  CHECK(scout->yaw_inertia == Approx(0.415));
  REQUIRE(scout->sonars.size() == 1);
  const SonarRing& ring = scout->sonars[0];
  CHECK(ring.count == 16);
  CHECK(ring.height == Approx(0.28));
  CHECK(ring.half_lobe == Approx(12.5 * kDegree));
  CHECK(ring.transducer(4).yaw == Approx(90.0 * kDegree));
  CHECK(ring.transducer(4).y == Approx(0.19));
  CHECK(ring.period == std::chrono::milliseconds{200});
  CHECK(ring.order[1] == 2);
  REQUIRE(scout->odometer.has_value());
  CHECK(scout->urdf.find("<robot name=\"nomad_scout\">") != std::string::npos);
}

TEST_CASE("masses and shapes of all links are carried into the frame of the root", "[sim][robot_file]") {
  const std::string arm = "<link name='arm'>" + kInertial +
                          "<collision><geometry><box size='0.4 0.1 0.1'/></geometry></collision></link>"
                          "<joint name='j' type='fixed'><parent link='base'/><child link='arm'/>"
                          "<origin xyz='0 0.1 0.5' rpy='0 0 1.5707963267948966'/></joint>";
  std::string errors;
  const auto model = read(replaced(robot(kBase + arm), "<orca", "<orca bumper_radius='0.4 m'"), errors);
  INFO(errors);
  REQUIRE(model);
  CHECK(model->mass == 20.0);
  CHECK(model->yaw_inertia == Approx(0.5 + 0.5 + 10.0 * 0.01));
  CHECK(model->top == Approx(0.55));
  CHECK(model->bottom == Approx(0.05));
  // Turned by 90 deg, the arm reaches 0.2 m along y from (0, 0.1).
  CHECK(contains(model->footprint, {0.0, 0.299}));
  CHECK_FALSE(contains(model->footprint, {0.22, 0.1}));
}

TEST_CASE("a file without robot, links, drive or extension is reported", "[sim][robot_file]") {
  CHECK_THAT(errors_of_robot("<world/>"),
             Catch::Contains("r.urdf:1:1: error R001: the root element is <world>"));
  CHECK_THAT(errors_of_robot("<robot name='r'/>"), Catch::Contains("error R011: the robot has no <link>") &&
                                                       Catch::Contains("needs the element <orca"));
  CHECK_THAT(
      errors_of_robot(robot(kBase, "")),
      Catch::Contains("r.urdf:3:1: error R004: <orca> needs the element <drive>, or at least a sensor"));
  CHECK_THAT(errors_of_robot(robot("<link name='base'/>")),
             Catch::Contains("error R018: no link of the robot has a mass") &&
                 Catch::Contains("no link of the robot has a <collision>"));
  CHECK_THAT(errors_of_robot("<robot"), Catch::Contains("r.urdf:1:"));
}

TEST_CASE("joints that do not make a tree are reported", "[sim][robot_file]") {
  CHECK_THAT(errors_with("<link name='b'/>"),
             Catch::Contains("error R014: the robot has 2 root links (b, base)"));
  CHECK_THAT(
      errors_with(joint("j", "bse", "base")),
      Catch::Contains(
          "r.urdf:3:44: error R012: there is no link \"bse\"; there is: base; did you mean \"base\"?"));
  CHECK_THAT(errors_with("<link name='b'/><link name='c'/>" + joint("j", "c", "b") + joint("k", "b", "c")),
             Catch::Contains("error R015: link \"b\" is its own ancestor: b <- c <- b"));
  CHECK_THAT(errors_with("<link name='b'/><link name='c'/>" + joint("i", "base", "b") +
                         joint("j", "base", "c") + joint("k", "b", "c")),
             Catch::Contains("error R013: link \"c\" is the child of joint \"k\" and of another joint"));
  CHECK_THAT(errors_with("<link name='base'/>"),
             Catch::Contains("error R010: there is a link \"base\" already, at r.urdf:2:1"));
  CHECK_THAT(errors_with("<joint name='j' type='fixed'/>"),
             Catch::Contains("<joint> needs the element <parent link=") &&
                 Catch::Contains("<joint> needs the element <child link="));
}

TEST_CASE("wrong joints are reported", "[sim][robot_file]") {
  const auto with = [](const std::string& type, const std::string& inside) {
    return errors_with("<link name='b'/><joint name='j' type='" + type +
                       "'><parent link='base'/><child link='b'/>" + inside + "</joint>");
  };
  CHECK_THAT(with("fixd", ""),
             Catch::Contains("error R005: type: \"fixd\" is not one of: fixed, continuous"));
  CHECK_THAT(with("continuous", "<axis xyz='0 0 0'/>"), Catch::Contains("error R016: the axis is zero"));
  CHECK_THAT(with("revolute", ""), Catch::Contains("error R004: a revolute joint needs the element <limit>"));
  CHECK_THAT(with("revolute", "<limit lower='1' upper='0' effort='1' velocity='1'/>"),
             Catch::Contains("error R017: the lower limit is above the upper one"));
  CHECK_THAT(with("fixed", "<origin xyz='0 nan 0'/>"), Catch::Contains("error R005: xyz"));
  CHECK_THAT(with("fixed", "<origin xyz='0 0'/>"), Catch::Contains("holds 2 numbers, expected 3"));
  CHECK_THAT(with("continuous", "<mimic joint='k'/>"),
             Catch::Contains("error R012: there is no joint \"k\""));
  CHECK_THAT(with("continuous", "<mimic joint='j'/>"),
             Catch::Contains("error R015: joint \"j\" mimics itself"));
}

TEST_CASE("wrong masses, inertias and shapes are reported", "[sim][robot_file]") {
  const auto base = [](const std::string& from, const std::string& to) {
    return errors_of_robot(robot(replaced(kBase, from, to)));
  };
  CHECK_THAT(base("value=\"10\"", "value=\"0\""),
             Catch::Contains("error R018: no link of the robot has a mass"));
  CHECK_THAT(base("value=\"10\"", "value=\"-1\""),
             Catch::Contains("error R018: the mass must not be negative"));
  CHECK_THAT(base("value=\"10\"", "value=\"1e999\""), Catch::Contains("error R005: value"));
  CHECK_THAT(base("ixx=\"1\"", "ixx=\"-1\""),
             Catch::Contains("error R019: the inertia is not positive definite"));
  CHECK_THAT(base("ixy=\"0\"", "ixy=\"1.5\""), Catch::Contains("error R019"));
  CHECK_THAT(base("ixy=\"0\"", ""), Catch::Contains("error R004: <inertia> needs the attribute \"ixy\""));
  CHECK_THAT(base("radius=\"0.2\"", "radius=\"-0.2\""), Catch::Contains("error R020: radius of <cylinder>"));
  CHECK_THAT(base("<cylinder radius=\"0.2\" length=\"0.3\"/>", "<box size=\"0.1 0 0.1\"/>"),
             Catch::Contains("error R020: size of <box>"));
  CHECK_THAT(base("<cylinder radius=\"0.2\" length=\"0.3\"/>", "<mesh filename=\"a.stl\"/>"),
             Catch::Contains("error R021: a.stl: there is no such mesh file"));
  CHECK_THAT(base("<cylinder radius=\"0.2\" length=\"0.3\"/>", "<cone/>"),
             Catch::Contains("error R002: <cone>"));
  CHECK_THAT(base("<cylinder radius=\"0.2\" length=\"0.3\"/>", ""),
             Catch::Contains("needs a <geometry> with a shape"));
  CHECK_THAT(
      base("radius=\"0.2\"", "radius=\"0.3\""),
      Catch::Contains(
          "error R023: the collision geometry reaches 0.3 m from the axis, but bumper_radius is 0.2 m"));
}

TEST_CASE("wrong devices are reported at their place", "[sim][robot_file]") {
  const auto device = [](const std::string& text, const std::string& from, const std::string& to) {
    return errors_of_robot(robot(kBase, kDrive + replaced(kRing, from, to) + text));
  };
  CHECK_THAT(errors_of_robot(robot(kBase, replaced(kDrive, "1 m/s\"", "1 kg\""))),
             Catch::Contains("r.urdf:3:60: error R005: max_speed: \"1 kg\""));
  CHECK_THAT(errors_of_robot(robot(kBase, replaced(kDrive, "0.35 m", "350"))),
             Catch::Contains("error R022: track must be at most four times the robot's radius; a length "
                             "without a unit is in metres"));
  CHECK_THAT(errors_of_robot(robot(kBase, replaced(kDrive, "0.15 m", "150"))),
             Catch::Contains("error R022: wheel_diameter must be at most four times"));
  CHECK_THAT(errors_of_robot(robot(kBase, replaced(kDrive, "track", "big_turn_angle=\"60\" track"))),
             Catch::Contains("error R022: big_turn_angle must be at most a turn; an angle without a unit is "
                             "in radians"));
  CHECK_THAT(device("", "link=\"base\"", "link=\"base\" quantum=\"20\""),
             Catch::Contains("error R022: quantum must be less than max_range; a length without a unit"));
  CHECK_THAT(errors_of_robot(robot(kBase, replaced(kDrive, "differential", "synkro"))),
             Catch::Contains("error R005: type: \"synkro\" is not one of: differential, synchro, holonomic; "
                             "did you mean \"synchro\"?"));
  CHECK_THAT(errors_of_robot(robot(kBase, kDrive + kDrive)),
             Catch::Contains("error R010: there is a <drive> already"));
  CHECK_THAT(errors_of_robot(robot(kBase, kDrive + kRing + kRing)),
             Catch::Contains("error R010: there is a sonar ring \"sonar\" already"));
  CHECK_THAT(device("", "link=\"base\"", "link=\"bas\""),
             Catch::Contains("error R012: there is no link \"bas\"; did you mean \"base\"?"));
  CHECK_THAT(device("", "count=\"4\"", "count=\"0\""),
             Catch::Contains("error R005: count: \"0\" is out of range: 1 to 256 is allowed"));
  CHECK_THAT(device("", "count=\"4\"", "count=\"4\" order=\"0 1 2 2\""),
             Catch::Contains("error R022: the firing order"));
  CHECK_THAT(device("", "0.1 m", "6 m"),
             Catch::Contains("error R022: min_range must be less than max_range"));
  CHECK_THAT(device("", "10 deg", "100 deg"),
             Catch::Contains("error R022: half_lobe must be at most 90 deg"));
  CHECK_THAT(device("", "0.2 s", "5 ms"), Catch::Contains("error R022: the period must be between"));
  CHECK_THAT(device("<odometry period='0 s'/>", "0.2 s", "0.2 s"),
             Catch::Contains("error R005: period: \"0 s\""));
  CHECK_THAT(device("<odometri/>", "0.2 s", "0.2 s"),
             Catch::Contains("error R002: there is no element <odometri> in <orca>; it may contain: drive"));
}

TEST_CASE("an uneven sonar ring lists where its transducers look and sit", "[sim][robot_file]") {
  const auto ring_with = [](const std::string& directions) {
    return robot(kBase, kDrive + replaced(kRing, "pitch=\"90 deg\"", directions));
  };
  std::string errors;
  const auto listed = read(ring_with("angles='90 50 -50 -90 deg'"), errors);
  REQUIRE(listed);
  CHECK(listed->sonars[0].transducer(1).yaw == Approx(50.0 * kDegree));
  CHECK(listed->sonars[0].transducer(3).y == Approx(-0.2));
  const auto placed =
      read(ring_with("angles='1.5 1 -1 -1.5' positions='0 0.1; 0.1 0.1; 0.1 -0.1; 0 -0.1'"), errors);
  REQUIRE(placed);
  CHECK(placed->sonars[0].transducer(2) == Pose2{0.1, -0.1, -1.0});

  CHECK_THAT(errors_of_robot(ring_with("angles='90 50 -50 deg'")),
             Catch::Contains("R005: angles: \"90 50 -50 deg\" holds 3 numbers, expected 4"));
  CHECK_THAT(errors_of_robot(ring_with("angles='90 x -50 5 deg'")), Catch::Contains("error R005: angles"));
  CHECK_THAT(errors_of_robot(ring_with("angles='1 2 3 4 m'")), Catch::Contains("error R005: angles"));
  CHECK_THAT(errors_of_robot(ring_with("angles='1 2 3 4' pitch='90 deg'")),
             Catch::Contains("error R022: the directions are given by angles already"));
  CHECK_THAT(errors_of_robot(ring_with("pitch='90 deg' positions='0 0; 0 0; 0 0; 0 0'")),
             Catch::Contains("error R022: positions need angles"));
  CHECK_THAT(errors_of_robot(ring_with("angles='1 2 3 4' positions='0 0; 1 1'")),
             Catch::Contains("error R022: there are 2 positions for 4 transducers"));
}

TEST_CASE("a missing robot file is reported with its name", "[sim][robot_file]") {
  orca::xml::Diagnostics diagnostics;
  CHECK_FALSE(read_robot("no/robot.urdf", diagnostics).has_value());
  CHECK_THAT(diagnostics.text(), Catch::StartsWith("no/robot.urdf"));
}

TEST_CASE("sensors without a drive are fixed, and need no mass", "[sim][robot_file]") {
  const std::string laser = R"(<laser name="l" link="base" count="3" first_angle="0 deg" pitch="1 deg")"
                            R"( max_range="8 m" period="100 ms"/>)";
  std::string errors;
  const auto scanner = read(robot("<link name='base'>" + kCollision + "</link>", laser), errors);
  INFO(errors);
  REQUIRE(scanner);
  CHECK(scanner->fixed);
  const auto driven = read(robot(kBase, kDrive + laser), errors);
  REQUIRE(driven);
  CHECK_FALSE(driven->fixed);
  CHECK_THAT(errors_of_robot(robot(kBase, laser + R"(<odometry period="50 ms"/>)")),
             Catch::Contains("error R004: <orca> needs the element <drive>, because it has <odometry>"));
}
