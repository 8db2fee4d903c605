// SPDX-License-Identifier: GPL-3.0-or-later
// Configurations of the thesis as graphs.
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "deployer.hpp"
#include "importing/component_file.hpp"
#include "subprocess.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::orcactl::importing;
using namespace orca::test;
using Catch::Contains;
using namespace std::chrono_literals;

namespace {

/// A server as the thesis writes one.
std::string server(const std::string& port, const char* named = "true", const char* traded = "false") {
  return "<server id=\"x\"><NameService><use>" + std::string(named) + "</use><nsName>" + port +
         "</nsName></NameService><TraderService><use>" + traded +
         "</use><serviceType></serviceType></TraderService></server>\n";
}

const std::string kHead =
    "<?xml version=\"1.0\" encoding=\"ISO-8859-1\" standalone=\"no\"?>\n"
    "<!DOCTYPE component SYSTEM \"component04.dtd\">\n";

/// A base with sonars, with the elements, attributes and figures of the thesis's Appendix A.
std::string base_file() {
  return kHead +
         "<component>\n<componentName>RobotBaseServerComponent</componentName>\n"
         "<rootContextName>default</rootContextName>\n"
         "<context id=\"sensors\" name=\"Sensors\">\n<context id=\"odometry\" name=\"OdometryServer\">\n" +
         server("OdometryPush") + "</context></context>\n" + server("MotionCommandSend") +
         "<hardware>\n<library>libOrocosNomadScout.so</library>\n"
         "<robot><name>Dewey</name><vendor>Nomadics</vendor><model>SuperScout</model>\n"
         "<radius>190</radius><bumper_radius>205</bumper_radius></robot>\n"
         "<sensors><sensor id=\"sonarring1\"><sensor_type>\n"
         "<sonar-ring number_of_sonars=\"16\" dphi=\"225\" angle_sonar0_x_axis=\"0\" "
         "half_lobe_angle=\"125\"\n"
         "scalefactor=\"0.0435\" offset=\"-12.0\"/>\n"
         "</sensor_type><vendor>Polaroid</vendor><update_interval>0.2</update_interval></sensor></sensors>\n"
         "<actuators><actuator id=\"actuator1\"><actuator_type><drive>\n"
         "<drive_type><differential/></drive_type><maxspeed>1000</maxspeed>\n"
         "<max_steerspeed>1</max_steerspeed><steergain>0.5</steergain>\n<dspeed>50</dspeed>\n"
         "<big_turnangle>1</big_turnangle><big_turnspeed>12.5</big_turnspeed>\n"
         "</drive></actuator_type></actuator></actuators>\n</hardware>\n</component>\n";
}

struct Imported {
  std::string graph;
  std::string said;
  bool failed = false;
};

Imported imported(const std::string& text) {
  xml::Diagnostics found;
  const ComponentFile file = read_component_file(text, "base.xml", found);
  const std::string graph = found.has_errors() ? "" : graph_text(file, "base.xml", found);
  return {graph, found.text(), found.has_errors()};
}

std::string replaced(std::string text, const std::string& old, const std::string& other) {
  REQUIRE(text.find(old) != std::string::npos);
  return text.replace(text.find(old), old.size(), other);
}

}  // namespace

TEST_CASE("a configuration of the thesis becomes hardware and a component in SI units", "[orcactl][import]") {
  const Imported base = imported(base_file());
  REQUIRE_FALSE(base.failed);
  CHECK_THAT(base.graph, Contains("<hardware name=\"Dewey\" type=\"orca.hw.NomadScout\">"));
  CHECK_THAT(base.graph, Contains("name=\"max_speed\" value=\"1 m/s\"") &&
                             Contains("name=\"max_turn_rate\" value=\"1 rad/s\"") &&
                             Contains("name=\"sonar_interval\" value=\"0.0125 s\""));
  CHECK_THAT(base.graph, Contains("<component name=\"RobotBaseServerComponent\" "
                                  "type=\"orca.RobotBaseServer\" hardware=\"Dewey\"/>"));
  CHECK_THAT(base.graph, Contains("RobotBaseServerComponent.OdometryPush\n"));
  CHECK_THAT(base.graph, Contains("radius=\"0.19 m\" bumper_radius=\"0.205 m\""));
  CHECK_THAT(base.graph, Contains("count=\"16\" first_angle=\"0 rad\" pitch=\"0.3926990817 rad\" "
                                  "half_lobe=\"0.2181661565 rad\" period=\"0.2 s\" vendor=\"Polaroid\""));
  CHECK_THAT(base.graph, Contains("<drive type=\"differential\"") && Contains("steer_gain=\"0.5\"") &&
                             Contains("big_turn_angle=\"1 rad\" big_turn_speed=\"0.0125 m/s\""));
}

TEST_CASE("what has no equivalent is said, all at once and with its line", "[orcactl][import]") {
  const std::string said = imported(base_file()).said;
  CHECK_THAT(said, Contains("base.xml:6:1: warning I001: the context \"Sensors\""));
  CHECK_THAT(said, Contains("base.xml:7:1: warning I001: the context \"OdometryServer\""));
  CHECK_THAT(said, Contains("base.xml:17:1: warning I001: scalefactor=\"0.0435\""));
  CHECK_THAT(said, Contains("base.xml:17:22: warning I001: offset=\"-12.0\""));
  CHECK_THAT(said, Contains("base.xml:22:1: warning I001: dspeed 50"));
  CHECK(std::ranges::count(said, '\n') == 5);
  CHECK_THAT(imported(replaced(base_file(), "<context id=\"sensors\"",
                               server("SonarPush", "true", "true") + "<context id=\"sensors\""))
                 .said,
             Contains("warning I001: a trader that is told of \"SonarPush\""));
}

TEST_CASE("a service that nobody is to find by name is a disabled port", "[orcactl][import]") {
  const std::string graph =
      imported(replaced(base_file(), server("OdometryPush"), server("OdometryPush", "false"))).graph;
  CHECK_THAT(graph, Contains("<port name=\"OdometryPush\" disabled=\"true\"/>"));
  CHECK_THAT(graph, !Contains("RobotBaseServerComponent.OdometryPush"));
}

TEST_CASE("end tags that close nothing, as the thesis prints some, are left out with a word",
          "[orcactl][import]") {
  const Imported base =
      imported(replaced(base_file(), "<bumper_radius>", "</robot></hardware>\n<bumper_radius>"));
  REQUIRE_FALSE(base.failed);
  CHECK_THAT(base.said, Contains("warning I003: </robot> closes nothing and is left out"));
  CHECK_THAT(base.said, Contains("warning I003: </hardware> closes nothing and is left out"));
  CHECK_THAT(base.graph, Contains("bumper_radius=\"0.205 m\""));
}

TEST_CASE("a component in a context of its own has it in its name", "[orcactl][import]") {
  CHECK_THAT(imported(replaced(base_file(), ">default<", ">Dewey<")).graph,
             Contains("<component name=\"Dewey/RobotBaseServerComponent\""));
}

TEST_CASE("elements, components and libraries that Orca does not know are named", "[orcactl][import]") {
  CHECK_THAT(
      imported(replaced(base_file(), "<sensors>", "<camera><focus>3</focus></camera>\n<sensors>")).said,
      Contains("warning I002: the element <camera> is not known"));
  const Imported other = imported(replaced(
      replaced(base_file(), "RobotBaseServerComponent", "MyPlannerComponent"), "NomadScout", "Roomba"));
  CHECK_THAT(other.said, Contains("base.xml: warning I006: \"MyPlannerComponent\" is no component"));
  CHECK_THAT(other.said, Contains("base.xml: warning I006: Orca has no driver in place of"));
  CHECK_THAT(other.graph, Contains("<component name=\"MyPlannerComponent\" hardware=\"Dewey\"/>"));
}

TEST_CASE("what cannot be read is an error, and nothing is written", "[orcactl][import]") {
  const Imported base = imported(replaced(replaced(base_file(), ">1000<", ">fast<"), "\"225\"", "\"22,5\""));
  CHECK(base.failed);
  CHECK_THAT(base.said, Contains("error I004: maxspeed: ") && Contains("error I004: dphi: "));
  CHECK_THAT(imported("<graph/>").said, Contains("base.xml:1:1: error I005: this is no component's file"));
  CHECK_THAT(imported("<component/>").said, Contains("error I005: the component has no <componentName>"));
  CHECK(imported(base_file().substr(0, 400)).failed);
  CHECK(imported("<!DOCTYPE component [<!ENTITY a \"b\">]><component/>").failed);
}

TEST_CASE("a file that ends early is an error, wherever it ends", "[orcactl][import]") {
  const std::string whole = base_file();
  for (std::size_t size = 0; size + 2 < whole.size(); ++size) {
    INFO(size);
    CHECK(imported(whole.substr(0, size)).failed);
  }
}

TEST_CASE("a file of end tags that close nothing is read in a moment", "[orcactl][import]") {
  std::string text = "<component>\n";
  for (int i = 0; i < 100'000; ++i) text += "</a>\n";
  const Imported base = imported(text + "<componentName>GotoComponent</componentName></component>\n");
  CHECK_FALSE(base.failed);
  CHECK_THAT(base.graph, Contains("type=\"orca.Goto\""));
}

TEST_CASE("the text may be in ISO-8859-1", "[orcactl][import]") {
  CHECK_THAT(imported(replaced(base_file(), ">Nomadics<", ">M\xFCller<")).graph,
             Contains("vendor=\"M\xC3\xBCller\""));
}

TEST_CASE("orcactl import prints a graph that the deployer finds right, or says why not",
          "[orcactl][import]") {
  const TempFolder folder;
  const std::string file = folder.write("base.xml", base_file());
  Subprocess import({ORCA_BINARY_DIR "/bin/orcactl", "import", file});
  REQUIRE(import.wait(30s)->exit_code == 0);
  CHECK_THAT(import.err(), Contains(file + ":22:1: warning I001: dspeed"));
  const Run check = run_deployer({folder.write("graph.xml", import.out()), "--check"});
  INFO(check.err);
  CHECK(check.exit_code() == 0);

  Subprocess wrong({ORCA_BINARY_DIR "/bin/orcactl", "import", folder.write("wrong.xml", "<graph/>")});
  CHECK(wrong.wait(30s)->exit_code == 1);
  CHECK(wrong.out().empty());
  Subprocess none({ORCA_BINARY_DIR "/bin/orcactl", "import", folder.file("none.xml")});
  CHECK(none.wait(30s)->exit_code == 1);
  CHECK_THAT(none.err(), Contains("none.xml: No such file"));
}

TEST_CASE("docs/errors-elsewhere.md explains every code of import, and no other", "[orcactl][import][docs]") {
  const std::string page = read_text(ORCA_SOURCE_DIR "/docs/errors-elsewhere.md");
  for (const char* code : {"I001", "I002", "I003", "I004", "I005", "I006"})
    CHECK_THAT(page, Contains("\n| " + std::string(code) + " | "));
  CHECK_THAT(page, !Contains("\n| I007"));
}
