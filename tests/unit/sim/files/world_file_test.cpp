// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/sim/world_file.hpp"

using namespace orca::sim;
using orca::Vec2;

namespace {

// A world around `content`, which begins at line 2.
std::string file(const std::string& content) {
  return "<world name=\"w\" version=\"1\">\n" + content + "\n</world>\n";
}

WorldModel good(const std::string& content) {
  orca::xml::Diagnostics diagnostics;
  const auto world = read_world_text(file(content), "w.xml", diagnostics);
  INFO(diagnostics.text());
  REQUIRE(world);
  return *world;
}

std::string errors_of_world(const std::string& text) {
  orca::xml::Diagnostics diagnostics;
  const auto world = read_world_text(text, "w.xml", diagnostics);
  CHECK_FALSE(world.has_value());
  return diagnostics.text();
}

std::string errors_within(const std::string& content) { return errors_of_world(file(content)); }

}  // namespace

TEST_CASE("a wall reaches half its thickness over its ends, so that corners close", "[sim][world_file]") {
  const WorldModel w = good(R"(<wall from="0 0" to="4 0" thickness="200 mm" height="2 m"/>)");
  REQUIRE(w.obstacles.size() == 1);
  const Bounds b = bounds_of(w.obstacles[0].shape);
  CHECK(b.low.x == Approx(-0.1));
  CHECK(b.high.x == Approx(4.1));
  CHECK(b.high.y == Approx(0.1));
  CHECK(w.obstacles[0].height == 2.0);
  CHECK(w.obstacles[0].name == "wall");
}

TEST_CASE("doors leave openings in a wall", "[sim][world_file]") {
  const WorldModel w = good(
      R"(<wall from="0 0" to="0 6"><door at="4.5 m" width="1 m"/><door at="1.5 m" width="90 cm"/></wall>)");
  CHECK(w.obstacles.size() == 3);
  CHECK(w.obstacle_at(Circle{{0.0, 1.5}, 0.44}, 0.0) == nullptr);
  CHECK(w.obstacle_at(Circle{{0.0, 1.5}, 0.46}, 0.0) != nullptr);
  CHECK(w.obstacle_at(Circle{{0.0, 4.5}, 0.49}, 0.0) == nullptr);
  CHECK(w.obstacle_at(Circle{{0.0, 3.0}, 0.1}, 0.0) != nullptr);
}

TEST_CASE("a room is four walls with doors counted from the west and the south", "[sim][world_file]") {
  const WorldModel w =
      good(R"(<room name="r" from="1 1" to="5 4"><door side="east" at="1 m" width="1 m"/></room>)");
  CHECK(w.obstacles.size() == 5);
  CHECK(w.obstacle_at(Circle{{5.0, 2.0}, 0.45}, 0.0) == nullptr);
  CHECK(w.obstacle_at(Circle{{5.0, 3.0}, 0.1}, 0.0) != nullptr);
  CHECK(w.obstacle_at(Circle{{3.0, 2.5}, 1.4}, 0.0) == nullptr);
  for (const Vec2 corner : {Vec2{1, 1}, Vec2{5, 1}, Vec2{5, 4}, Vec2{1, 4}})
    CHECK(w.obstacle_at(Circle{corner, 0.01}, 0.0) != nullptr);
}

TEST_CASE("boxes, cylinders, polygons and places take units and angles", "[sim][world_file]") {
  const WorldModel w = good(R"(
    <box name="desk" x="2 m" y="100 cm" yaw="90 deg" length="1.6 m" width="80 cm" height="0.7 m"/>
    <cylinder x="5" y="5" radius="250 mm"/>
    <polygon points="8 0; 9 0; 9000 mm, 1 m; 8 1"/>
    <place name="goal" x="3" y="3" yaw="270 deg"/>)");
  REQUIRE(w.obstacles.size() == 3);
  CHECK(contains(w.obstacles[0].shape, {2.0, 1.79}));
  CHECK_FALSE(contains(w.obstacles[0].shape, {2.5, 1.0}));
  CHECK(contains(w.obstacles[1].shape, {5.2, 5.0}));
  CHECK(contains(w.obstacles[2].shape, {8.9, 0.9}));
  REQUIRE(w.place("goal") != nullptr);
  CHECK(w.place("goal")->pose.yaw == Approx(-0.5 * std::numbers::pi));
}

TEST_CASE("items take units, and may stand below a table top", "[sim][world_file]") {
  const WorldModel w = good(R"(
    <box name="table" x="2" y="1" length="1.6 m" width="80 cm" height="0.74 m" bottom="0.7 m"/>
    <item name="can" x="200 cm" y="1 m" radius="33 mm" height="12 cm"/>
    <item name="tin" x="2.2" y="1" radius="0.05" height="0.1"/>)");
  REQUIRE(w.items.size() == 2);
  CHECK(w.items[0].name == "can");
  CHECK(w.items[0].pose == orca::Pose2{2.0, 1.0, 0.0});
  CHECK(w.items[0].radius == Approx(0.033));
  CHECK(w.items[0].height == Approx(0.12));
  CHECK(w.items[1].name == "tin");
}

TEST_CASE("a file that is not a world is reported as that", "[sim][world_file]") {
  CHECK(errors_of_world("<graph/>") ==
        "w.xml:1:1: error W001: the root element is <graph>; a world file begins with <world name=\"...\" "
        "version=\"1\">\n");
  CHECK_THAT(errors_of_world("<world name='w' version='2'/>"),
             Catch::Contains("w.xml:1:26: error W010: version \"2\" of the world format is not known"));
  CHECK_THAT(errors_of_world("<world name='w' version='1'>"), Catch::Contains("w.xml:1:"));
  CHECK_THAT(errors_of_world("<world/>"),
             Catch::Contains("error W004: <world> needs the attribute \"name\"") &&
                 Catch::Contains("needs the attribute \"version\""));
}

TEST_CASE("unknown elements and attributes are reported with the nearest name", "[sim][world_file]") {
  CHECK_THAT(errors_within("<wal from='0 0' to='1 1'/>"),
             Catch::Contains(
                 "w.xml:2:1: error W002: there is no element <wal> in <world>; it may contain: wall, room"));
  CHECK_THAT(
      errors_within("<box x='0' y='0' lenght='1 m' length='1 m' width='1 m'/>"),
      Catch::Contains("w.xml:2:18: error W003: <box> has no attribute \"lenght\"; it has: name, x, y"));
  CHECK_THAT(errors_within("text"), Catch::Contains("w.xml:2:1: error W006"));
}

TEST_CASE("wrong values are reported at their place", "[sim][world_file]") {
  CHECK_THAT(errors_within("<cylinder x='0' y='0'/>"),
             Catch::Contains("w.xml:2:1: error W004") && Catch::Contains("radius"));
  CHECK_THAT(errors_within("<cylinder x='0' y='0' radius='-1 m'/>"),
             Catch::Contains("w.xml:2:31: error W005: radius: \"-1 m\" is out of range: more than 0"));
  CHECK_THAT(errors_within("<cylinder x='0' y='0' radius='1 kg'/>"),
             Catch::Contains("error W005: radius: \"1 kg\""));
  CHECK_THAT(errors_within("<cylinder x='nan' y='0' radius='1 m'/>"), Catch::Contains("error W005: x"));
  CHECK_THAT(errors_within("<wall from='0' to='1 1'/>"),
             Catch::Contains("w.xml:2:13: error W005: from: \"0\" is not a point"));
  CHECK_THAT(errors_within("<wall from='0 0' to='1 x'/>"),
             Catch::Contains("error W005: to: \"1 x\" is not a point"));
  CHECK_THAT(errors_within("<place name='far' x='1e300' y='0'/>"),
             Catch::Contains("error W005: x: \"1e300\" is out of range: -100000 to 100000 m"));
  CHECK_THAT(errors_within("<wall from='0 0' to='1e6 1'/>"),
             Catch::Contains("error W005: to: \"1e6 1\" is farther"));
  CHECK_THAT(errors_within("<place name='1st' x='0' y='0'/>"),
             Catch::Contains("error W005: name: \"1st\" is not a name"));
}

TEST_CASE("walls and rooms that cannot be built are reported", "[sim][world_file]") {
  CHECK_THAT(errors_within("<wall from='1 1' to='1 1'/>"),
             Catch::Contains("error W008: the wall begins and ends"));
  CHECK_THAT(errors_within("<wall from='0 0' to='2 0'><door at='1.8 m' width='1 m'/></wall>"),
             Catch::Contains("error W008: the door at 1.8 m, 1 m wide, reaches over the end of its wall"));
  CHECK_THAT(
      errors_within("<wall from='0 0' to='9 0'><door at='2' width='1'/><door at='2.5' width='1'/></wall>"),
      Catch::Contains("reaches into the door before it"));
  CHECK_THAT(errors_within("<room from='0 0' to='-1 2'/>"),
             Catch::Contains("error W008: \"to\" must lie right of and above"));
  CHECK_THAT(errors_within("<room from='0 0' to='4 4'><door side='up' at='2' width='1'/></room>"),
             Catch::Contains("error W005: side: \"up\" is not one of: south, north, west, east"));
}

TEST_CASE("polygons that bound no area are reported", "[sim][world_file]") {
  const auto polygon = [](const std::string& points) {
    return errors_within("<polygon points='" + points + "'/>");
  };
  CHECK_THAT(polygon("0 0; 1 0"),
             Catch::Contains("w.xml:2:18: error W009: a polygon needs at least 3 corners, found 2"));
  CHECK_THAT(polygon("0 0; 1 0; 1 1; 0 0"), Catch::Contains("error W009: the last corner repeats the first"));
  CHECK_THAT(polygon("0 0; 1 1; 1 0; 0 1"), Catch::Contains("error W009: two sides of the polygon cross"));
  CHECK_THAT(polygon("0 0; 1 0; 1 0; 0 1"), Catch::Contains("error W009: two corners in a row"));
  CHECK_THAT(polygon("0 0; 1 0; 2 0"), Catch::Contains("error W009: the polygon has no area"));
}

TEST_CASE("names must be unique, and places must lie outside obstacles", "[sim][world_file]") {
  CHECK_THAT(errors_within("<place name='a' x='0' y='0'/><place name='a' x='1' y='1'/>"),
             Catch::Contains("error W007: the place \"a\" exists already, at w.xml:2:1"));
  CHECK_THAT(errors_within("<place name='a' x='0' y='0'/><cylinder name='c' x='0' y='0' radius='1'/>"),
             Catch::Contains("w.xml:2:1: error W012: place \"a\" lies inside obstacle \"c\""));
}

TEST_CASE("all errors of a file are reported at once", "[sim][world_file]") {
  const std::string text = errors_within("<wal/>\n<box/>\n<place name='a' x='1 kg' y='0'/>");
  CHECK_THAT(text, Catch::Contains("w.xml:2:1: error W002") && Catch::Contains("w.xml:3:1: error W004") &&
                       Catch::Contains("w.xml:4:"));
}

TEST_CASE("a bitmap that cannot be read is reported at the element that names it", "[sim][world_file]") {
  CHECK_THAT(errors_within("<bitmap file='no.png' width='10 m'/>"),
             Catch::Contains("w.xml:2:15: error W011: no.png: cannot read the picture: No such file"));
  orca::xml::Diagnostics diagnostics;
  CHECK_FALSE(read_world("no/map.png", {10.0, {}}, diagnostics).has_value());
  CHECK(diagnostics.text() == "no/map.png: error W011: cannot read the picture: No such file or directory\n");
}

TEST_CASE("a map width is refused for an XML world", "[sim][world_file]") {
  orca::xml::Diagnostics diagnostics;
  CHECK_FALSE(read_world(ORCA_SOURCE_DIR "/sim/worlds/office.xml", {10.0, {}}, diagnostics).has_value());
  CHECK_THAT(diagnostics.text(), Catch::Contains("error W013: map_width is for bitmaps"));
}

TEST_CASE("ten thousand obstacles are read and cast against", "[sim][world_file]") {
  std::string content;
  for (int i = 0; i < 10'000; ++i)
    content +=
        "<cylinder x='" + std::to_string(i % 100) + "' y='" + std::to_string(i / 100) + "' radius='0.1'/>";
  CHECK(good(content).obstacles.size() == 10'000);
}
