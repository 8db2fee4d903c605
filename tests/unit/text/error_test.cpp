// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "orca/idl/navigation.hpp"
#include "reading.hpp"

using orca::test::reading;

namespace {

std::string errors(const std::string& text) {
  const auto result = reading(text);
  CHECK_FALSE(result.object);
  return result.errors;
}

// Returns every "Tnnn" that follows `before` in a file of the source tree.
std::set<std::string> codes_in(const std::string& path, const std::string& before) {
  std::ostringstream stream;
  stream << std::ifstream(std::string(ORCA_SOURCE_DIR) + "/" + path).rdbuf();
  const std::string text = stream.str();
  std::set<std::string> codes;
  for (std::size_t at = text.find(before); at != std::string::npos; at = text.find(before, at + 1))
    codes.insert("T" + text.substr(at + before.size(), 3));
  return codes;
}

}  // namespace

TEST_CASE("an unknown object type is reported with the nearest one", "[text][errors]") {
  CHECK_THAT(errors("<GoalPiont/>"),
             Catch::StartsWith("x:1:1: error T001: <GoalPiont>: there is no such object type; there are: ") &&
                 Catch::EndsWith("; did you mean \"GoalPoint\"?\n"));
  CHECK_THAT(errors("<Frame3D/>"), Catch::Contains("T001"));  // A part of objects, but no object itself.
}

TEST_CASE("an object of another type than expected is reported", "[text][errors]") {
  CHECK(reading("<Arrived/>", &orca::object_type<orca::idl::GoalPoint>()).errors ==
        "x:1:1: error T001: <Arrived>: a <GoalPoint> is expected here\n");
  CHECK(reading("<GoalPoint/>", &orca::object_type<orca::idl::Door>()).errors ==
        "x:1:1: error T001: <GoalPoint>: a <Door> is expected here\n");
}

TEST_CASE("where a type is expected, one that extends it is read as what it is", "[text][errors]") {
  const auto door = reading("<Door name='a' passable='true'/>", &orca::object_type<orca::idl::GoalPoint>());
  REQUIRE(door.object);
  CHECK(&door.object->type() == &orca::object_type<orca::idl::Door>());
  CHECK(static_cast<const orca::idl::Door*>(door.object->get())->passable());
}

TEST_CASE("an unknown field is reported with the valid ones and the nearest", "[text][errors]") {
  CHECK(errors("<Ask abuot='x'/>") ==
        "x:1:6: error T002: <Ask>: there is no \"abuot\"; there are: creation_time, origin, origin_port, "
        "seq, mission, "
        "about, "
        "cause; did you mean \"about\"?\n");
  CHECK(errors("<Ask><abuot/></Ask>") ==
        "x:1:6: error T002: <Ask>: there is no \"abuot\"; there are: creation_time, origin, origin_port, "
        "seq, mission, "
        "about, "
        "cause; did you mean \"about\"?\n");
}

TEST_CASE("for a value written as an element, or a struct as an attribute, the error shows the correct form",
          "[text][errors]") {
  CHECK(errors("<Ask><about>x</about></Ask>") ==
        "x:1:6: error T003: <Ask>: \"about\" is one value: write it as an attribute, about=\"...\"\n");
  CHECK(errors("<Ask cause='goto 3'/>") ==
        "x:1:6: error T003: <Ask>: \"cause\" has parts: write it as an element inside, <cause .../>\n");
  CHECK(errors("<GoalPoint><coordinate><point x='1'/></coordinate></GoalPoint>") ==
        "x:1:24: error T003: <coordinate>: what belongs to \"point\" is written on <coordinate> itself\n");
}

TEST_CASE("too many parts or too few numbers are reported", "[text][errors]") {
  CHECK(errors("<Ask><cause seq='1'/><cause seq='2'/></Ask>") ==
        "x:1:22: error T004: <Ask>: <cause> is written 1 time or not at all, found 2\n");
  CHECK(errors("<RobotPose covariance='1 2 3'/>") ==
        "x:1:24: error T004: <RobotPose>: covariance: 9 values with blanks between them are expected, found "
        "3\n");
}

TEST_CASE("text between tags is reported", "[text][errors]") {
  CHECK(errors("<Ask>\n  sonar\n</Ask>") ==
        "x:2:3: error T005: <Ask>: text between tags is not read; a value is written as an attribute, "
        "name=\"value\"\n");
}

TEST_CASE("a value that does not fit its type is reported with the expected form", "[text][errors]") {
  CHECK(errors("<Battery charging='yes'/>") ==
        "x:1:20: error T006: <Battery>: charging: \"yes\" is neither true nor false\n");
  CHECK(errors("<Battery voltage='24,5 V'/>") ==
        "x:1:19: error T006: <Battery>: voltage: \"24,5 V\" is not a number: write a decimal point, \"24.5 "
        "V\"\n");
  CHECK_THAT(errors("<LaserRangeReadings ranges='1 x 3'/>"),
             Catch::Contains("error T006: <LaserRangeReadings>: ranges: value 2: \"x\" is not a number"));
}

TEST_CASE("a wrong unit is reported with those that fit", "[text][errors]") {
  CHECK(errors("<WDistance distance='3 kg'/>") ==
        "x:1:22: error T007: <WDistance>: distance: \"3 kg\": \"kg\" measures a mass; a length is "
        "expected: write "
        "m, mm, cm or km\n");
  CHECK(errors("<WDistance distance='inf kg'/>") ==
        "x:1:22: error T007: <WDistance>: distance: \"inf kg\": \"kg\" measures a mass; a length is "
        "expected: "
        "write m, mm, cm or km\n");
  CHECK_THAT(errors("<RobotPose covariance='1 0 0 0 1 0 0 0 1 m2'/>"),
             Catch::Contains("error T007") &&
                 Catch::Contains("write numbers alone here, their units differ: m2, m rad, rad2"));
}

TEST_CASE("a value that has become a struct is reported with its new form", "[text][errors]") {
  CHECK(errors("<GoalPoint reach_radius='0.3 m'/>") ==
        "x:1:12: error T003: <GoalPoint>: \"reach_radius\" has parts: write it as an element inside, "
        "<reach_radius .../>\n");
}

TEST_CASE("an unknown enumerator is reported with the valid ones", "[text][errors]") {
  CHECK(
      errors("<MotionCommand kind='FULSTOP'/>") ==
      "x:1:22: error T009: <MotionCommand>: kind: \"FULSTOP\" is no MotionKind; there are: NORMAL, DONTCARE, "
      "FULLSTOP; did you mean \"FULLSTOP\"?\n");
}

TEST_CASE("for a lone backslash the error shows the correct form", "[text][errors]") {
  for (const char* about : {"a\\n", "\\", "\\x", "\\x4", "\\xg0", "\\x 4"}) {
    CHECK_THAT(errors(std::string("<Ask about='") + about + "'/>"),
               Catch::Contains("error T010: <Ask>: about: a backslash is written \\\\"));
  }
}

TEST_CASE("all errors of a text are reported at once, ordered by place", "[text][errors]") {
  const std::string text = errors(
      "<GoalPoint nmae='a' reach_angle='x'\n  via='1'>\n <coordinate x='1 s' w='2'/>\n <cause "
      "seq='-1'/>\n</GoalPoint>");
  std::istringstream lines(text);
  std::string places;
  for (std::string line; std::getline(lines, line);) places += line.substr(0, line.find(": <")) + "\n";
  CHECK(places ==
        "x:1:12: error T002\nx:1:34: error T006\nx:2:8: error T006\nx:3:17: error T007\nx:3:22: error T002\n"
        "x:4:14: error T008\n");
}

TEST_CASE("an error of the XML itself does not hide those of the content", "[text][errors]") {
  const std::string text = errors("<Ask about='R&D' abuot='x'/>");
  CHECK_THAT(text, Catch::Contains("error G117") && Catch::Contains("error T002"));
}

TEST_CASE("errors that were reported before do not count", "[text][errors]") {
  orca::xml::Diagnostics diagnostics;
  diagnostics.error("G001", {"other", 1, 1}, "an error of another file");
  CHECK(orca::from_xml("<Ask/>", "x", diagnostics));
}

TEST_CASE("docs/errors-elsewhere.md explains every code of the text form, and no other",
          "[text][errors][docs]") {
  CHECK(codes_in("docs/errors-elsewhere.md", "\n| T") == codes_in("src/text/codes.hpp", "\"T"));
}

TEST_CASE("every code of the text form appears in a test", "[text][errors]") {
  std::set<std::string> shown = codes_in("tests/unit/text/error_test.cpp", "error T");
  shown.merge(codes_in("tests/unit/text/plain_test.cpp", "error T"));
  CHECK(std::ranges::includes(shown, codes_in("src/text/codes.hpp", "\"T")));
}
