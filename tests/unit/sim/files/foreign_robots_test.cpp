// SPDX-License-Identifier: GPL-3.0-or-later
// Robot files in the ways in which people write them for other programs. Each needs <orca>, and nothing else of it is changed.
#include <catch2/catch.hpp>

#include <filesystem>

#include "orca/sim/robot_file.hpp"
#include "temp_folder.hpp"

namespace fs = std::filesystem;
using orca::test::TempFolder;

namespace {

const std::string kDriveOfForeign =
    R"x(<orca radius="0.3 m"><drive type="differential" max_speed="1 m/s" max_steer_speed="2 rad/s"
max_acceleration="1 m/s2" max_steer_acceleration="4 rad/s2" track="0.3 m" wheel_diameter="0.15 m" steer_gain="2"/></orca>)x";

const std::string kChassis =
    R"x(<link name="base_link"><inertial><origin xyz="0 0 0.1"/><mass value="9"/>
<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.12" iyz="0" izz="0.15"/></inertial>
<collision><origin xyz="0 0 0.12"/><geometry><box size="0.4 0.3 0.2"/></geometry></collision></link>
)x";

// A cube of 0.2 m about the origin, as OBJ.
const std::string kCube = R"x(v -0.1 -0.1 -0.1
v 0.1 -0.1 -0.1
v 0.1 0.1 -0.1
v -0.1 0.1 -0.1
v -0.1 -0.1 0.1
v 0.1 -0.1 0.1
v 0.1 0.1 0.1
v -0.1 0.1 0.1
f 1 2 3 4
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
)x";
const std::string kCollada = R"x(<?xml version="1.0"?><COLLADA version="1.4.1"><asset/></COLLADA>)x";

std::string chassis_of_mesh(const std::string& filename) {
  return R"x(<link name="base_link"><inertial><mass value="9"/>
<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.12" iyz="0" izz="0.15"/></inertial>
<collision><origin xyz="0 0 0.12"/><geometry><mesh filename=")x" +
         filename + R"x("/></geometry></collision></link>)x";
}

std::string on_footprint(const std::string& inside, const std::string& in_joint = "") {
  return R"x(<link name="base_footprint"/><joint name="foot" type="fixed"><parent link="base_footprint"/>
<child link="base_link"/><origin xyz="0 0 0.02" rpy="0 0 0"/>)x" +
         in_joint + "</joint>\n" + inside;
}

std::string urdf_of(const std::string& inside) {
  return "<robot name=\"r\">\n" + inside + kDriveOfForeign + "</robot>\n";
}

struct Reading {
  std::optional<orca::sim::RobotModel> robot;
  std::string said;
};

Reading reading_of(const std::string& file, const std::string& packages = {}) {
  orca::xml::Diagnostics diagnostics;
  Reading reading;
  reading.robot = orca::sim::read_robot(file, diagnostics, packages);
  reading.said = diagnostics.text();
  return reading;
}

// A workspace of ROS, with the robot in src/thing_description/urdf/r.urdf.
class Workspace {
 public:
  void put(const std::string& name, const std::string& text) const {
    fs::create_directories(fs::path(folder_.file(name)).parent_path());
    folder_.write(name, text);
  }
  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }
  [[nodiscard]] Reading read(const std::string& urdf, const std::string& packages = {}) const {
    put("src/thing_description/urdf/r.urdf", urdf);
    return reading_of(file("src/thing_description/urdf/r.urdf"), packages);
  }
  [[nodiscard]] Reading read_mesh(const std::string& filename, const std::string& packages = {}) const {
    return read(urdf_of(on_footprint(chassis_of_mesh(filename))), packages);
  }

 private:
  TempFolder folder_;
};

void check_is_cube(const Reading& reading) {
  INFO(reading.said);
  REQUIRE(reading.robot);
  CHECK(reading.robot->bottom == Approx(0.04));
  CHECK(reading.robot->top == Approx(0.24));
}

void check_is_read(const std::string& urdf) {
  const Reading reading = Workspace().read(urdf);
  INFO(reading.said);
  REQUIRE(reading.robot);
  CHECK(reading.said.empty());
  CHECK(reading.robot->mass == Approx(9.0));
  CHECK(reading.robot->top == Approx(0.24));
}

}  // namespace

TEST_CASE("a mesh in a package is found by the name of a folder above the robot", "[sim][foreign]") {
  const Workspace space;
  space.put("src/thing_description/meshes/body.obj", kCube);
  for (const char* const scheme : {"package://", "model://"})
    check_is_cube(space.read_mesh(std::string(scheme) + "thing_description/meshes/body.obj"));
}

TEST_CASE("a mesh in a package is found beside the robot's package", "[sim][foreign]") {
  const Workspace space;
  space.put("src/thing_meshes/body.obj", kCube);
  check_is_cube(space.read_mesh("package://thing_meshes/body.obj"));
}

TEST_CASE("a mesh in a package is found by the name in package.xml, whatever the folder is called",
          "[sim][foreign]") {
  const Workspace space;
  space.put("src/thing_description/body.obj", kCube);
  space.put("src/thing_description/package.xml",
            "<?xml version=\"1.0\"?>\n<?xml-model href=\"package_format3.xsd\"?>\n<package format=\"3\">\n  "
            "<name> thing "
            "</name></package>");
  check_is_cube(space.read_mesh("package://thing/body.obj"));
}

TEST_CASE("a mesh in a package is found in the folder that the parameter packages names", "[sim][foreign]") {
  const Workspace space;
  space.put("elsewhere/thing/body.obj", kCube);
  check_is_cube(space.read_mesh("package://thing/body.obj", space.file("elsewhere")));
  CHECK_THAT(space.read_mesh("package://thing/head.obj", space.file("elsewhere")).said,
             Catch::Contains("R021") && Catch::Contains("there is no such file in the folder of packages"));
}

TEST_CASE("a package that is nowhere is refused with what to set", "[sim][foreign]") {
  CHECK_THAT(Workspace().read_mesh("package://thing/body.obj").said,
             Catch::Contains("error R021") && Catch::Contains("holds a package \"thing\"") &&
                 Catch::Contains("set the parameter packages"));
  CHECK_THAT(Workspace().read_mesh("https://example.org/body.obj").said,
             Catch::Contains("cannot be looked up; write package://PACKAGE/PATH"));
}

TEST_CASE("a mesh may be named by file://, by a path from / and by one beside the robot", "[sim][foreign]") {
  const Workspace space;
  space.put("src/thing_description/meshes/body.obj", kCube);
  const std::string path = space.file("src/thing_description/meshes/body.obj");
  for (const std::string& name : {"file://" + path, path, std::string("../meshes/body.obj")})
    check_is_cube(space.read_mesh(name));
}

TEST_CASE("of a COLLADA mesh the STL or OBJ file beside it is taken, with a warning", "[sim][foreign]") {
  const Workspace space;
  space.put("src/thing_description/meshes/body.dae", kCollada);
  const std::string name = "package://thing_description/meshes/body.dae";
  CHECK_THAT(space.read_mesh(name).said, Catch::Contains("error R021") &&
                                             Catch::Contains("this is a COLLADA file, which is not read") &&
                                             Catch::Contains("assimp export body.dae body.stl"));
  space.put("src/thing_description/meshes/body.obj", kCube);
  const Reading reading = space.read_mesh(name);
  check_is_cube(reading);
  CHECK_THAT(reading.said, Catch::Contains("warning R028") && Catch::Contains("body.obj beside it is taken"));
}

TEST_CASE("visual meshes are not looked for", "[sim][foreign]") {
  const std::string visual =
      R"x(<visual><geometry><mesh filename="package://nowhere/body.dae"/></geometry></visual>)x";
  std::string chassis = kChassis;
  check_is_read(urdf_of(on_footprint(chassis.insert(chassis.find("<collision>"), visual))));
}

TEST_CASE("an axis of a fixed joint may be zero, or empty", "[sim][foreign]") {
  for (const char* const axis : {"<axis xyz=\"0 0 0\"/>", "<axis/>"})
    check_is_read(urdf_of(on_footprint(kChassis, axis)));
}

TEST_CASE("a link that is only a frame may have the mass zero", "[sim][foreign]") {
  check_is_read(urdf_of(on_footprint(kChassis) +
                        R"x(<link name="camera"><inertial><mass value="0"/>
<inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial></link>
<joint name="eye" type="fixed"><parent link="base_link"/><child link="camera"/></joint>)x"));
}

TEST_CASE("a byte order mark and instructions for other programs are passed over", "[sim][foreign]") {
  const std::string urdf = urdf_of(on_footprint(kChassis));
  check_is_read("\xEF\xBB\xBF" + urdf);
  check_is_read("\xEF\xBB\xBF<?xml version=\"1.0\" encoding=\"utf-8\"?>\n" + urdf);
  check_is_read("<?xml version=\"1.0\"?>\n<?xml-model href=\"urdf.xsd\" type=\"application/xml\"?>\n" + urdf);
  check_is_read("<!-- made by hand -->\n<?editor fold=\"all\"?>\n" + urdf);
}

TEST_CASE("a comment may hold any number of dashes, and places of errors stay right", "[sim][foreign]") {
  const std::string ruled = "<!-- ------ wheels ------\n -- left -- -->\n";
  check_is_read("<?xml version=\"1.0\"?>" + ruled + urdf_of(ruled + on_footprint(kChassis)));
  CHECK_THAT(Workspace().read(ruled + "<robot name=\"r\">" + ruled + "<link/></robot>").said,
             Catch::Contains("r.urdf:5:1: error R004"));
}

TEST_CASE("xacro hears that it is xacro", "[sim][foreign]") {
  for (const char* const raw :
       {"<xacro:property name=\"r\" value=\"0.1\"/>", "<xacro:include filename=\"a.xacro\"/>",
        "<link name=\"${prefix}base\"/>", "<link name=\"$(arg name)\"/>"})
    CHECK_THAT(Workspace()
                   .read("<robot name=\"r\" xmlns:xacro=\"http://ros.org/wiki/xacro\">" + std::string(raw) +
                         "</robot>")
                   .said,
               Catch::Contains("error R025: this is xacro") && Catch::Contains("r.urdf > robot.urdf") &&
                   !Catch::Contains("R004"));
}

TEST_CASE("what xacro leaves behind when it expands is no xacro", "[sim][foreign]") {
  std::string urdf = urdf_of(on_footprint(kChassis));
  urdf.replace(urdf.find("<robot name"), 11, "<robot xmlns:xacro=\"http://ros.org/wiki/xacro\" name");
  check_is_read("<?xml version=\"1.0\" ?>\n<!-- ==== autogenerated by xacro from r.xacro ==== -->\n" + urdf);
}

TEST_CASE("elements that are for simulators and controllers of others are left alone", "[sim][foreign]") {
  check_is_read(urdf_of(R"x(<material name="grey"><color rgba="0.5 0.5 0.5 1"/></material>
<gazebo reference="base_link"><material>Gazebo/Grey</material><mu1>0.2</mu1></gazebo>
<transmission name="t"><type>transmission_interface/SimpleTransmission</type><joint name="foot"/></transmission>
<ros2_control name="c" type="system"><hardware><plugin>p</plugin></hardware></ros2_control>)x" +
                        on_footprint(kChassis)));
}

TEST_CASE("blanks are those of XML: tabs, line ends of any kind, and as many as there are",
          "[sim][foreign]") {
  std::string urdf = urdf_of(on_footprint(kChassis));
  urdf.replace(urdf.find("xyz=\"0 0 0.02\""), 14, "xyz = \"\t0  0\r\n   0.02 \"");
  check_is_read(urdf);
  std::string dos;
  for (const char c : urdf_of(on_footprint(kChassis)))
    dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
  check_is_read(dos);
  std::string spread = urdf_of(on_footprint(kChassis));
  spread.replace(spread.find("<mass value=\"9\"/>"), 17, "<mass\n\tvalue=\"9\"\n/>");
  check_is_read(spread);
}

TEST_CASE("numbers may be written as C writes them", "[sim][foreign]") {
  std::string urdf = urdf_of(on_footprint(kChassis));
  urdf.replace(urdf.find("xyz=\"0 0 0.02\""), 14, "xyz=\"-.0 +0. 2e-2\"");
  check_is_read(urdf);
}

TEST_CASE("an inertia that no body can have gives a warning", "[sim][foreign]") {
  std::string urdf = urdf_of(on_footprint(kChassis));
  urdf.replace(urdf.find("izz=\"0.15\""), 10, "izz=\"1.5\"");
  const Reading reading = Workspace().read(urdf);
  INFO(reading.said);
  CHECK(reading.robot);
  CHECK_THAT(reading.said, Catch::Contains("warning R026: no body has this inertia"));
  // A flat disc is at the limit, and its numbers are rounded.
  std::string disc = urdf_of(on_footprint(kChassis));
  disc.replace(disc.find("ixx=\"0.1\""), 9, "ixx=\"0.074\"")
      .replace(disc.find("iyy=\"0.12\""), 10, "iyy=\"0.075\"");
  check_is_read(disc);
}

TEST_CASE("an angle of a robot's file that is more than a turn is doubted: it may be one of degrees",
          "[sim][foreign]") {
  std::string urdf = urdf_of(on_footprint(kChassis));
  urdf.insert(urdf.find("<link name=\"base_link\""), R"x(<link name="eye"/>)x");
  const auto joint = [](const std::string& rpy) {
    return R"x(<joint name="neck" type="fixed"><parent link="base_link"/><child link="eye"/><origin rpy=")x" +
           rpy + R"x("/></joint>)x";
  };
  const auto said = [&](const std::string& rpy) {
    std::string text = urdf;
    text.insert(text.find("<orca"), joint(rpy));
    const Reading reading = Workspace().read(text);
    CHECK(reading.robot);
    return reading.said;
  };
  CHECK_THAT(said("0 0 -180"), Catch::Contains("warning R030: rpy is in radians"));
  CHECK_THAT(said("0 0 -6.28319"), !Catch::Contains("R030"));
}

TEST_CASE("a point of mass may have an inertia of zero, but not the whole robot", "[sim][foreign]") {
  const std::string nothing = R"x(<inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/>)x";
  const Reading lamp = Workspace().read(urdf_of(
      on_footprint(kChassis) +
      R"x(<link name="lamp"><inertial><origin xyz="0.1 0 0.3"/><mass value="0.1"/>)x" + nothing +
      R"x(</inertial></link><joint name="stand" type="fixed"><parent link="base_link"/><child link="lamp"/></joint>)x"));
  INFO(lamp.said);
  REQUIRE(lamp.robot);
  CHECK(lamp.robot->yaw_inertia == Approx(0.15 + 0.1 * 0.1 * 0.1));
  std::string urdf = urdf_of(on_footprint(kChassis));
  const std::size_t at = urdf.find("<inertia ixx");
  urdf.replace(at, urdf.find("/>", at) + 2 - at, nothing);
  CHECK_THAT(Workspace().read(urdf).said,
             Catch::Contains("error R019") && Catch::Contains("without an inertia about it"));
}

TEST_CASE(
    "where a robot's file does not say how to steer it, or how wrong its wheels are, the usual figures are "
    "taken with one warning",
    "[sim][foreign]") {
  std::string urdf = urdf_of(on_footprint(kChassis));
  urdf.replace(urdf.find(" steer_gain=\"2\"/>"), 17, "/><odometry period=\"50 ms\"/>");
  const Reading reading = Workspace().read(urdf);
  INFO(reading.said);
  REQUIRE(reading.robot);
  CHECK(reading.robot->drive.steer_gain == 2.0);
  CHECK(reading.robot->odometer->errors.at(orca::robot_file::Realism::nominal) == orca::kUsualWheelErrors);
  CHECK(reading.robot->odometer->errors.at(orca::robot_file::Realism::harsh) == orca::kUsualHarshWheelErrors);
  CHECK_THAT(reading.said, Catch::Contains("warning R029: the file says no steer_gain and wheel_errors"));
  CHECK(reading.said.find("R029") == reading.said.rfind("R029"));
  urdf.replace(urdf.find("track=\"0.3 m\""), 0, "steer_gain=\"1\" ");
  const Reading half = Workspace().read(urdf);
  CHECK_THAT(half.said, Catch::Contains("the file says no wheel_errors of this robot"));
  CHECK(half.robot->drive.steer_gain == 1.0);
}

TEST_CASE("a robot whose root is at the axle of its wheels hears how much too low it stands",
          "[sim][foreign]") {
  const Reading reading = Workspace().read(
      urdf_of(kChassis + R"x(<link name="wheel"><collision><origin rpy="1.5708 0 0"/><geometry>
<cylinder radius="0.08" length="0.03"/></geometry></collision></link><joint name="axle" type="continuous">
<parent link="base_link"/><child link="wheel"/><axis xyz="0 1 0"/></joint>)x"));
  INFO(reading.said);
  CHECK(reading.robot);
  CHECK_THAT(reading.said, Catch::Contains("warning R027: the robot reaches 0.08") &&
                               Catch::Contains("below its root link, which stands on the floor"));
}
