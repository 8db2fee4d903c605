// SPDX-License-Identifier: GPL-3.0-or-later
// Bad graphs, worlds and robots: exit 2, nothing is started, and the errors help.
#include <catch2/catch.hpp>

#include "damaged_file.hpp"
#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

// Returns scout_goto.xml for use in another folder: its paths to the world and the robot are absolute.
std::string scout_graph() {
  std::string text = read_text(source_file("graphs/scout_goto.xml"));
  const std::string path = "\"../sim/";
  for (auto at = text.find(path); at != std::string::npos; at = text.find(path, at))
    text.replace(at, path.size(), "\"" + source_file("sim/"));
  return text;
}

std::string scout_graph_with(const std::string& from, const std::string& to) {
  return damaged(scout_graph(), {from, to, "", {}}).text;
}

Run start(const std::string& graph, const Words& more = {}) {
  return run_deployer(Words{graph} + virtual_clock() + more);
}

// Returns the line of stderr that begins with "FILE:LINE:COLUMN: error".
std::string error_at(const std::string& place, const Run& run) {
  for (const std::string& line : split_lines(run.err))
    if (line.starts_with(place + ": error")) return line;
  return {};
}

void check_refused(const Run& run) {
  CHECK(run.ended);
  CHECK(run.exit_code() == 2);
  CHECK(run.out.empty());
  CHECK(run.err.find("INIT") == std::string::npos);
  CHECK(run.err.find("[   ") == std::string::npos);  // no log line of a running system
}

void check_error(const std::string& file, const Damaged& bad, const Damage& damage, const Run& run) {
  CAPTURE(damage.to);
  INFO(run.err);
  check_refused(run);
  const std::string place = file + ":" + line_and_column(bad.text, bad.place, damage.at);
  CAPTURE(place);
  const std::string said = error_at(place, run);
  CHECK_FALSE(said.empty());
  for (const std::string& hint : damage.hints) {
    CAPTURE(hint);
    CHECK(said.find(hint) != std::string::npos);
  }
}

void check_graph(const Damage& damage) {
  const TempFolder folder;
  const Damaged bad = damaged(scout_graph(), damage);
  const std::string file = folder.write("graph.xml", bad.text);
  check_error(file, bad, damage, start(file));
}

// Checks a damaged copy of a world or a robot that the good graph names.
void check_part(const std::string& part, const Damage& damage) {
  const TempFolder folder;
  const Damaged bad = damaged(read_text(source_file(part)), damage);
  const std::string file = folder.write("part" + part.substr(part.rfind('.')), bad.text);
  const std::string graph = folder.write("graph.xml", scout_graph_with(source_file(part), file));
  check_error(file, bad, damage, start(graph));
}

void check_world(const Damage& damage) { check_part("sim/worlds/office.xml", damage); }
void check_robot(const Damage& damage) { check_part("sim/robots/nomad_scout.urdf", damage); }

}  // namespace

TEST_CASE("the graph, world and robot that these tests damage are good before", "[system][bad]") {
  const TempFolder folder;
  const Run run = run_deployer({folder.write("graph.xml", scout_graph()), "--check"});
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.err.find("error:") == std::string::npos);
}

TEST_CASE("a misspelt word in a graph is found, and the nearest valid one is offered", "[system][bad]") {
  check_graph({"type=\"orca.SonarAvoid\"", "type=\"orca.SonarAvoit\"", "orca", {"\"orca.SonarAvoid\""}});
  check_graph({"from=\"goto.MotionCmdPush\"", "from=\"goto.MotionCmdPsh\"", "goto", {"\"MotionCmdPush\""}});
  check_graph({"to=\"fuser.ClientListSend\"", "to=\"fusr.ClientListSend\"", "fusr", {"\"fuser\""}});
  check_graph({"<component name=\"goto\"", "<componnt name=\"goto\"", "<", {"componnt", "component"}});
  check_graph({"ends=\"command\"", "end=\"command\"", "end", {"\"ends\""}});
  check_graph({"ends=\"command\"", "ends=\"comand\"", "comand", {"\"command\""}});
  check_graph({"name=\"behaviours\"", "name=\"behavours\"", "behavours", {"\"behaviours\""}});
  check_graph({"default_profile=\"sim\"", "default_profile=\"simm\"", "simm", {"\"sim\""}});
  check_graph({"hardware=\"scout\"", "hardware=\"scot\"", "scot", {"\"scout\""}});
  check_graph({"\"${realism}\"", "\"${realizm}\"", "${", {"realizm", "\"realism\""}});
}

TEST_CASE("a wrong value of a parameter is refused with what was expected", "[system][bad]") {
  const auto with = [](const std::string& param, const std::string& value, std::vector<std::string> hints) {
    check_graph({"<component name=\"avoid\" type=\"orca.SonarAvoid\"/>",
                 "<component name=\"avoid\" type=\"orca.SonarAvoid\"><param name=\"" + param + "\" value=\"" +
                     value + "\"/></component>",
                 value, std::move(hints)});
  };
  with("margin", "-5 cm", {"margin", "0 m"});
  with("margin", "5 s", {"margin", "m"});
  with("margin", "0,05", {"margin", "."});
  with("margin", "wide", {"margin", "wide"});
  with("margin", "nan", {"margin"});
  check_graph({"<param name=\"realism\" value=\"${realism}\"/>",
               "<param name=\"realism\" value=\"nominl\"/>",
               "nominl",
               {"ideal", "harsh", "\"nominal\""}});
}

TEST_CASE("a wire that does not fit is refused with both of its ends", "[system][bad]") {
  const std::string good = "<connect from=\"base.SonarRangeReadingsPush\" to=\"avoid.sonar\"/>";
  check_graph({good,
               "<connect from=\"base.OdometryPush\" to=\"avoid.sonar\"/>",
               "<connect",
               {"base.OdometryPush", "avoid.sonar", "Odometry", "SonarRangeReadings"}});
  check_graph({good,
               "<connect from=\"avoid.sonar\" to=\"base.SonarRangeReadingsPush\"/>",
               "<connect",
               {"avoid.sonar", "base.SonarRangeReadingsPush"}});
  // The second of two equal connections is the one to refuse. Two spaces distinguish it from the first.
  check_graph({good,
               good + "\n  <connect  from=\"base.SonarRangeReadingsPush\" to=\"avoid.sonar\"/>",
               "<connect  from",
               {"base.SonarRangeReadingsPush", "avoid.sonar"}});
}

TEST_CASE("all faults of a graph are reported at once, in the order of the file", "[system][bad]") {
  const TempFolder folder;
  Damaged bad{scout_graph()};
  const std::vector<Damage> damages{
      {"ends=\"command\"", "ends=\"comand\"", "comand", {}},
      {"name=\"behaviours\"", "name=\"behavours\"", "behavours", {}},
      {"type=\"orca.MotionCommandFuser\"", "type=\"orca.MotionComandFuser\"", "orca", {}},
      {"to=\"goto.GotoCoordinateSend\"", "to=\"goto.GotoCordinateSend\"", "goto", {}},
      {"<param name=\"place\"", "<parm name=\"place\"", "<parm", {}}};
  for (const Damage& damage : damages) bad = damaged(bad.text, damage);
  const std::string file = folder.write("graph.xml", bad.text);
  const Run run = start(file);
  INFO(run.err);
  check_refused(run);
  std::size_t last = 0;
  for (const Damage& damage : damages) {
    CAPTURE(damage.to);
    const std::string where = line_and_column(bad.text, bad.text.find(damage.to), damage.at);
    const auto place = run.err.find(file + ":" + where + ": error");
    REQUIRE(place != std::string::npos);
    CHECK(place >= last);
    last = place;
  }
}

TEST_CASE(
    "what is wrong with the graphs that a run goes over to is said together with what is wrong with the "
    "first one",
    "[system][bad]") {
  const TempFolder folder;
  (void)folder.write("later.xml", R"(<graph name="g"><component name="b" type="orca.Gotto"/></graph>)");
  const std::string file =
      folder.write("graph.xml", R"(<graph name="g"><component name="a" type="orca.Comand"/>
    <change at="-1 s" graph="nowhere.xml"/><change at="2 s" graph="later.xml"/></graph>)");
  const Run run = run_deployer({file, "--check"});
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  for (const char* const part : {"orca.Comand", "\"-1 s\" is out of range", "nowhere.xml", "orca.Gotto"})
    CHECK(run.says(part));
}

TEST_CASE("a file that is not a graph is refused, and the error says what it is", "[system][bad]") {
  const TempFolder folder;
  const std::string good = scout_graph();
  const auto refuses = [&](const std::string& file, const std::string& hint) {
    const Run run = start(file);
    CAPTURE(file);
    INFO(run.err);
    check_refused(run);
    CHECK(run.says(file));
    CHECK(run.says(hint));
  };
  refuses(folder.file("missing.xml"), "No such file");
  refuses(folder.path().string(), "irectory");
  refuses(folder.write("empty.xml", ""), "empty");
  refuses(folder.write("binary.xml", std::string("\x7f", 1) + "ELF"), ":1:1: error");
  refuses(folder.write("cut.xml", good.substr(0, good.find("<profile"))), "<graph>");
  refuses(folder.write("other.xml", "<world name=\"a\" version=\"1\"/>\n"), ":1:1: error");
  refuses(folder.write("tags.xml", scout_graph_with("</profile>", "</profil>")), "</profil>");
}

TEST_CASE("a broken world is refused with file, line and column", "[system][bad]") {
  check_world({"<cylinder name=\"bin_1\"", "<cylindre name=\"bin_1\"", "<cylindre", {"cylinder"}});
  check_world({"radius=\"0.15 m\"", "radius=\"-0.15 m\"", "-0.15", {"radius"}});
  check_world({"radius=\"0.15 m\"", "radius=\"0.15 kg\"", "0.15", {"kg", "m"}});
  check_world({"radius=\"0.15 m\"", "radios=\"0.15 m\"", "radios", {"\"radius\""}});
  check_world({"name=\"desk_2\"", "name=\"desk_1\"", "desk_1", {"desk_1"}});
  check_world({"<place name=\"corridor_east\" x=\"17.0 m\" y=\"6.0 m\"/>",
               "<place name=\"corridor_east\" x=\"17.5 m\" y=\"11.5 m\"/>",
               "<place",
               {"corridor_east", "plant_2"}});
  check_world({"</world>", "</wrld>", "</wrld>", {"<world>", "</wrld>"}});
}

TEST_CASE("a broken robot is refused with file, line and column", "[system][bad]") {
  check_robot({"<parent link=\"base_footprint\"/>",
               "<parent link=\"base_footprnt\"/>",
               "base_footprnt",
               {"\"base_footprint\""}});
  check_robot({"<mass value=\"23\"/>", "<mass value=\"-23\"/>", "-23", {"mass"}});
  check_robot({"radius=\"0.19\" length=\"0.27\"", "radius=\"nan\" length=\"0.27\"", "nan", {"radius"}});
  check_robot({"<inertia ixx=\"0.337\"", "<inertia ixx=\"-0.337\"", "<inertia", {"positive definite"}});
  check_robot({"<link name=\"right_wheel\">", "<link name=\"left_wheel\">", "left_wheel", {"left_wheel"}});
}

TEST_CASE("a world or a robot that is not there is named together with the parameter that names it",
          "[system][bad]") {
  for (const char* part : {"office.xml", "nomad_scout.urdf"}) {
    const TempFolder folder;
    const std::string graph = folder.write("graph.xml", scout_graph_with(part, "lost_" + std::string(part)));
    const Run run = start(graph);
    CAPTURE(part);
    INFO(run.err);
    check_refused(run);
    CHECK(run.says("lost_" + std::string(part)));
    CHECK(run.says("No such file"));
  }
}

TEST_CASE("a start that does not exist is refused with the nearest place", "[system][bad]") {
  check_graph({"<param name=\"place\" value=\"${place}\"/>",
               "<param name=\"place\" value=\"strat\"/>",
               "strat",
               {"\"start\""}});
}

TEST_CASE("a start inside a wall is refused before anything starts", "[system][bad]") {
  const TempFolder folder;
  const std::string wall = "<param name=\"x\" value=\"0 m\"/><param name=\"y\" value=\"5 m\"/>";
  const std::string graph =
      folder.write("graph.xml", scout_graph_with("<param name=\"place\" value=\"${place}\"/>", wall));
  const Run run = start(graph);
  INFO(run.err);
  check_refused(run);
  CHECK(run.says("inside"));
  CHECK(run.says(graph + ":"));
}

TEST_CASE("two robots with one name are refused before anything starts, where the second gets it",
          "[system][bad]") {
  const std::string graph = system_graph("two_deweys.xml");
  for (const Words& options : {Words{"--until", "1 s"}, Words{"--check"}}) {
    const Run run = start(graph, options);
    INFO(run.err);
    check_refused(run);
    CHECK(run.says(graph + ":15:31: error G042"));
    CHECK(run.says("there is a robot \"Dewey\" in this world already, that of hardware \"one\""));
  }
}

TEST_CASE("two robots cannot share a world at two levels of realism", "[system][bad]") {
  const std::string graph = system_graph("two_realisms.xml");
  const Run run = start(graph, {"--until", "1 s"});
  INFO(run.err);
  check_refused(run);
  CHECK(run.says(graph + ":16:34: error G042"));
  CHECK(run.says("has this world with realism ideal, and this one wants realism harsh"));
}

TEST_CASE("a start beyond any world is refused before anything starts", "[system][bad]") {
  const Run run = start(source_file("graphs/random_walk.xml"),
                        {"--check", "--set", "place=", "--set", "x=1e300 m", "--set", "y=-1e300 m"});
  INFO(run.err);
  check_refused(run);
  CHECK(run.says("parameter \"x\": \"1e300 m\" is out of range"));
  CHECK(run.says("parameter \"y\": \"-1e300 m\" is out of range"));
}

TEST_CASE("a system that does not come up draws no picture, and a requested one does no harm",
          "[system][bad]") {
  const TempFolder folder;
  const Run run = start(source_file("graphs/scout_goto.xml"), {"--set", "goals=kitchen 3 4", "--picture",
                                                               folder.file("run.svg"), "--until", "1 s"});
  INFO(run.err);
  CHECK(run.ended);
  CHECK((run.exit_code() == 2 || run.exit_code() == 3));
  CHECK(run.says("a goal looks like"));
}
