// SPDX-License-Identifier: GPL-3.0-or-later
// What a component gives its successor: values one after the other, each with its kind.
#include "orca/component/state.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <deque>
#include <map>
#include <set>

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/idl/navigation.hpp"

using namespace orca;
using Catch::Contains;

namespace {

enum class Side { left, right };

struct Plain {
  int number = 0;
  std::string text;
  std::vector<double> values;
  friend bool operator==(const Plain&, const Plain&) = default;
};

class Private {
 public:
  Private() = default;
  explicit Private(int number) : number_(number) {}
  auto state() { return std::tie(number_, plain_); }
  friend bool operator==(const Private&, const Private&) = default;

 private:
  int number_ = 0;
  Plain plain_{3, "three", {0.1}};
};

StateReader reader_of(const StateWriter& writer) { return {{"test.Any", 1}, writer.bytes()}; }

// Returns the value as it comes back.
template <class T>
T passed_on(const T& value) {
  StateWriter writer;
  writer.write(value);
  StateReader reader = reader_of(writer);
  T back{};
  const Status read = reader.read(back);
  INFO((read.ok() ? "" : read.error().text()));
  REQUIRE(read.ok());
  CHECK(reader.finish().ok());
  return back;
}

}  // namespace

TEMPLATE_TEST_CASE("a number comes back as it was written, the extreme ones too", "[component][state]",
                   std::int8_t, std::uint8_t, std::int32_t, std::uint32_t, std::int64_t, std::uint64_t, float,
                   double) {
  for (const TestType value : {std::numeric_limits<TestType>::lowest(), TestType(0), TestType(1),
                               std::numeric_limits<TestType>::max()})
    CHECK(passed_on(value) == value);
}

TEST_CASE("all that a component keeps comes back: texts, times, containers, structs, objects",
          "[component][state]") {
  CHECK(passed_on(true));
  CHECK(passed_on(Side::right) == Side::right);
  CHECK(passed_on(std::string("two\0words", 9)) == std::string("two\0words", 9));
  CHECK(passed_on(Duration(1500ms)) == 1500ms);
  CHECK(passed_on(kForever) == kForever);
  CHECK(passed_on(std::optional<double>{}) == std::nullopt);
  CHECK(passed_on(std::optional<double>{2.5}) == 2.5);
  CHECK(passed_on(std::vector<bool>{true, false}) == std::vector<bool>{true, false});
  CHECK(passed_on(std::deque<std::string>{"a", ""}) == std::deque<std::string>{"a", ""});
  CHECK(passed_on(std::array<int, 3>{1, 2, 3}) == std::array<int, 3>{1, 2, 3});
  CHECK(passed_on(std::set<int>{3, 1}) == std::set<int>{1, 3});
  const std::map<std::string, std::vector<int>> map{{"a", {1, 2}}, {"b", {}}};
  CHECK(passed_on(map) == map);
  const Plain plain{7, "seven", {1.0, 2.0}};
  CHECK(passed_on(plain) == plain);
  CHECK(passed_on(std::vector<Plain>{plain, {}}) == std::vector<Plain>{plain, {}});
  CHECK(passed_on(Private(9)) == Private(9));
  CHECK(passed_on(Pose2{1.0, 2.0, 0.5}).yaw == 0.5);
  idl::GoalPoint goal;
  goal.name() = "kitchen";
  CHECK(passed_on(goal).name() == goal.name());
}

TEST_CASE("a shared object comes back as the type that it is, with its header; an empty view as an empty one",
          "[component][state]") {
  auto door = make_object<idl::Door>();
  door->name() = "front";
  door->mission(7);
  const ObjectPtr<idl::GoalPoint> goal = ObjectPtr<idl::Door>(std::move(door));
  const ObjectPtr<idl::GoalPoint> back = passed_on(goal);
  REQUIRE(back);
  CHECK(back.as<idl::Door>());
  CHECK(back->name() == goal->name());
  CHECK(back->mission() == 7);
  CHECK_FALSE(passed_on(ObjectPtr<idl::GoalPoint>{}));
  StateWriter writer;
  writer.write(goal);
  StateReader reader = reader_of(writer);
  ObjectPtr<idl::Path> other;
  CHECK_THAT(reader.read(other).error().message, Contains("an object of another type"));
}

TEST_CASE("a reader that expects something else changes nothing, and says which value it is",
          "[component][state]") {
  StateWriter writer;
  writer.write(1, std::string("two"), 3.0);
  int number = -1;
  double real = -1.0;
  StateReader reader = reader_of(writer);
  CHECK_THAT(reader.read(number, real).error().message,
             Contains("value 2 of the state is a text, where a real number is expected"));
  CHECK(number == -1);
  CHECK(real == -1.0);
  CHECK_FALSE(reader.finish().ok());
}

TEST_CASE("what is missing and what is left over are errors", "[component][state]") {
  StateWriter writer;
  writer.write(1, 2);
  int a = 0;
  int b = 0;
  int c = 0;
  StateReader longer = reader_of(writer);
  CHECK_THAT(longer.read(a, b, c).error().message, Contains("value 3 of the state is missing"));
  StateReader shorter = reader_of(writer);
  CHECK(shorter.read(a).ok());
  CHECK_THAT(shorter.finish().error().message,
             Contains("values are left in the state after the 1 that were read"));
}

TEST_CASE("a number that has no room in its new place, and an array of another length, are errors",
          "[component][state]") {
  StateWriter writer;
  writer.write(300, std::array<int, 2>{1, 2});
  std::uint8_t small = 0;
  StateReader number = reader_of(writer);
  CHECK_THAT(number.read(small).error().message,
             Contains("value 1 of the state is a number too large for its place"));
  int wide = 0;
  std::array<int, 3> longer{};
  StateReader array = reader_of(writer);
  CHECK_THAT(array.read(wide, longer).error().message, Contains("an array of another length"));
}

TEST_CASE("a state that was cut off anywhere is an error, never a crash", "[component][state]") {
  StateWriter writer;
  idl::GoalPoint goal;
  goal.name() = "kitchen";
  writer.write(std::string("text"), std::vector<int>{1, 2, 3}, goal);
  for (std::size_t length = 0; length < writer.bytes().size(); ++length) {
    StateReader reader({"test.Any", 1}, std::span(writer.bytes()).first(length));
    std::string text;
    std::vector<int> list;
    idl::GoalPoint back;
    CHECK_FALSE(reader.read(text, list, back).ok());
  }
}
