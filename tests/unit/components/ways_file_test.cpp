// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/planning/ways_file.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <string>

#include "temp_folder.hpp"

using namespace orca;
using Catch::Contains;

namespace {

Result<planning::Ways> ways_of(const test::TempFolder& folder, const std::string& content) {
  return planning::read_ways(
      folder.write("ways.xml", "<ways name=\"floor\" version=\"1\">\n" + content + "\n</ways>"));
}

}  // namespace

TEST_CASE("a topological map has places, doors and legs", "[ways_file]") {
  const test::TempFolder folder;
  const auto ways = ways_of(folder, R"(<place name="kitchen" x="3 m" y="4 m" in="kitchen"/>
<leg from="kitchen" to="door"/>
<leg from="door" to="hall" length="350 cm" one_way="true"/>
<door name="door" x="3 m" y="2 m" yaw="90 deg" width="0.9 m" from="hall" into="kitchen"/>
<place name="hall" x="0 m" y="1 m" in="hall"/>)");
  REQUIRE(ways);
  REQUIRE(ways->points.size() == 3);
  CHECK(ways->points[0].name == "kitchen");
  CHECK_FALSE(ways->points[0].door);
  REQUIRE(ways->points[1].door);
  CHECK(ways->points[1].door->direction == Approx(std::numbers::pi / 2.0));
  CHECK(ways->points[1].door->width == Approx(0.9));
  REQUIRE(ways->legs.size() == 2);
  CHECK(ways->legs[0].cost == Approx(2.0));  // as long as straight
  CHECK(ways->legs[0].to_side == 1);         // where the door's direction points
  CHECK(ways->legs[1].cost == Approx(3.5));
  CHECK(ways->legs[1].from_side == 0);
  CHECK(ways->legs[1].one_way);
}

TEST_CASE("all that is wrong with a topological map is reported at once, with line and column",
          "[ways_file]") {
  const test::TempFolder folder;
  const auto ways = ways_of(folder, R"(<place name="kitchen" x="three" y="4 m" in="a"/>
<door name="door" x="3 m" y="2 m" width="0.9 m" from="a" into="b"/>
<place name="hall" x="0 m" y="1 m" in="a"/>
<place name="hall" x="5 m" y="1 m" in="a"/>
<place name="office" x="0 m" y="9 m" in="a"/>
<leg from="hall" to="hal"/>
<leg from="hall" to="hall"/>
<leg from="hall" to="office" length="1 m"/>
<leg from="hall" to="office" oneway="true"/>
<doors name="x"/>
<place name="yard" x="0 m" y="20 m" in="c"/>
<leg from="hall" to="yard"/>
<door name="d1" x="1 m" y="5 m" yaw="0 deg" width="1 m" from="a" into="b"/>
<door name="d2" x="1 m" y="8 m" yaw="0 deg" width="1 m" from="a" into="b"/>
<leg from="d1" to="d2"/>
<leg from="d1" to="d2" in="c"/>
<door name="d3" x="1 m" y="8 m" yaw="0 deg" width="1 m" from="a" into="a"/>)");
  REQUIRE_FALSE(ways);
  const std::string& text = ways.error().message;
  CHECK_THAT(text, Contains("ways.xml:2:") && Contains("Y005"));
  CHECK_THAT(text, Contains("ways.xml:3:") && Contains("Y004") && Contains("\"yaw\""));
  CHECK_THAT(text, Contains("ways.xml:5:14: error Y007") && Contains("choose another name"));
  CHECK_THAT(text, Contains("ways.xml:7:22: error Y008") && Contains("did you mean \"hall\""));
  CHECK_THAT(text, Contains("ways.xml:8:22: error Y008") && Contains("another place than it begins at"));
  CHECK_THAT(text, Contains("ways.xml:9:38: error Y008") && Contains("cannot be shorter than straight"));
  CHECK_THAT(text, Contains("ways.xml:10:") && Contains("Y003") && Contains("\"one_way\""));
  CHECK_THAT(text, Contains("ways.xml:11:") && Contains("Y002"));
  CHECK_THAT(text, Contains("ways.xml:13:") && Contains("have no room in common"));
  CHECK_THAT(text, Contains("ways.xml:16:") && Contains("give the attribute \"in\""));
  CHECK_THAT(text, Contains("ways.xml:17:") && Contains("the one that both ends are in"));
  CHECK_THAT(text, Contains("ways.xml:18:") && Contains("Y011"));
}

TEST_CASE("another file, another version and no file are refused with what was expected, as topological maps",
          "[ways_file]") {
  const test::TempFolder folder;
  CHECK_THAT(planning::read_ways(folder.write("a.xml", "<layer name=\"a\" version=\"1\"/>")).error().message,
             Contains("Y001") && Contains("<ways name="));
  CHECK_THAT(planning::read_ways(folder.write("b.xml", "<ways name=\"a\" version=\"2\"/>")).error().message,
             Contains("Y009"));
  CHECK_THAT(planning::read_ways("no.xml").error().message, Contains("no.xml"));
}
