// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "all_objects.hpp"
#include "random_object.hpp"

using orca::object_type;

namespace {

template <class T>
std::string dump(const T& object) {
  return object_type<T>().dump(&object);
}

// The lines, without their values, that a dump must have: "  name: ... unit".
class Lines final : public orca::FieldVisitor {
 public:
  void field(const orca::FieldInfo& info, const orca::Value&) override {
    const std::string unit = info.unit == "1" ? "" : std::string(info.unit);
    lines.emplace_back("\n  " + std::string(info.name) + ": ", unit);
  }
  std::vector<std::pair<std::string, std::string>> lines;
};

}  // namespace

TEMPLATE_LIST_TEST_CASE("dump of any object starts with its type and shows every field with its unit",
                        "[idl][dump]", orca::test::AllObjects) {
  auto object = orca::test::random_object<TestType>(4);
  const std::string text = dump(object) + "\n  ";
  CHECK_THAT(text, Catch::StartsWith(std::string(object_type<TestType>().name) + "\n"));
  Lines fields;
  object_type<TestType>().fields(&object, fields);
  std::size_t at = 0;
  for (const auto& [start, unit] : fields.lines) {
    INFO(start);
    at = text.find(start, at);
    REQUIRE(at != std::string::npos);
    const std::string line = text.substr(at, text.find("\n  ", at + 1) - at);
    CHECK(line.size() > start.size());
    CHECK((unit.empty() || line.ends_with(" " + unit)));
  }
}

TEST_CASE("dump shows each field on a line with its unit, enums by name and times in seconds",
          "[idl][dump]") {
  orca::idl::MotionCommand command;
  command.creation_time().ns(12'050'000'000);
  command.origin("goto");
  command.origin_port("motion");
  command.seq(17);
  command.mission(3);
  command.cause().origin("sonar");
  command.cause().port("ring");
  command.cause().seq(5);
  command.kind(orca::idl::FULLSTOP);
  command.steering(orca::idl::BY_TURN_RATE);
  command.turn_rate(-0.25);
  command.speed(1e-7);
  command.weight(2.0);
  CHECK(dump(command) ==
        "MotionCommand\n"
        "  creation_time: 12.050000000 s\n"
        "  origin: \"goto\"\n"
        "  origin_port: \"motion\"\n"
        "  seq: 17\n"
        "  mission: 3\n"
        "  cause: {origin: \"sonar\", port: \"ring\", seq: 5}\n"
        "  kind: FULLSTOP\n"
        "  steering: BY_TURN_RATE\n"
        "  direction: 0 rad\n"
        "  turn_rate: -0.25 rad/s\n"
        "  speed: 1e-07 m/s\n"
        "  weight: 2");
}

TEST_CASE("dump shows numbers in one list and structs one per line", "[idl][dump]") {
  orca::idl::SonarRangeReadings sonar;
  sonar.ranges({1.5, 0.25});
  sonar.stamps().resize(2);
  sonar.stamps()[0].ns(-1'500'000'000);
  sonar.poses().resize(2);
  sonar.poses()[1].rotation().yaw(0.5);
  const std::string text = dump(sonar);
  CHECK_THAT(text, Catch::Contains("\n  ranges: [1.5, 0.25] m\n"));
  CHECK_THAT(text, Catch::Contains("\n  stamps: [-1.500000000 s, 0.000000000 s]\n"));
  CHECK_THAT(text, Catch::Contains("\n    1: {position: {x: 0 m, y: 0 m, z: 0 m}, "
                                   "rotation: {roll: 0 rad, pitch: 0 rad, yaw: 0.5 rad}}]\n"));
}

TEST_CASE("dump leaves out the header of objects within objects, which nobody stamps", "[idl][dump]") {
  orca::idl::Robot robot;
  robot.drives().resize(1);
  robot.drives()[0].name("wheels");
  robot.drives()[0].type(orca::idl::SYNCHRO);
  robot.drives()[0].steer_gain(1.5);
  const std::string text = dump(robot);
  CHECK_THAT(text, Catch::Contains("\n    0: {name: \"wheels\", vendor: \"\""));
  CHECK_THAT(text, Catch::Contains("type: SYNCHRO"));
  CHECK_THAT(text, Catch::Contains("steer_gain: 1.5 1/s"));
}

TEST_CASE("dump keeps a text on its line and marks its quotes", "[idl][dump]") {
  orca::idl::Ask ask;
  ask.about("a \"b\"\nc\\");
  CHECK_THAT(dump(ask), Catch::EndsWith("\n  about: \"a \\\"b\\\" c\\\\\""));
}

TEST_CASE("dump shows control characters by number, so that a text cannot command a terminal",
          "[idl][dump]") {
  orca::idl::Ask ask;
  ask.about(std::string("\x1b[31m\x7f\0", 7));
  CHECK_THAT(dump(ask), Catch::EndsWith("\n  about: \"\\x1b[31m\\x7f\\x00\""));
}

TEST_CASE("dump marks an enumerator that does not exist", "[idl][dump]") {
  orca::idl::MotionCommand command;
  command.kind(static_cast<orca::idl::MotionKind>(9));
  CHECK_THAT(dump(command), Catch::Contains("kind: unknown 9\n"));
}
