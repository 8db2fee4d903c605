// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/base/layout.hpp"

#include <catch2/catch.hpp>

using orca::layout_difference;

TEST_CASE("two layouts of one type differ in their first different field", "[base][layout]") {
  const std::string pose = "Odometry{stamp:TimeValue{ns:int64 {ns}},pose:Point{x:double {m},y:double {m}}}";

  SECTION("in its type or its unit") {
    CHECK(layout_difference("A{x:double {m},y:double {m}}", "A{x:double {m},y:double {cm}}") ==
          R"x(the field "y" is "double {m}" at the from end and "double {cm}" at the to end)x");
    CHECK(layout_difference("A{e:Mode(on,off)}", "A{e:Mode(on,off,auto)}") ==
          R"x(the field "e" is "Mode(on,off)" at the from end and "Mode(on,off,auto)" at the to end)x");
  }
  SECTION("in its name") {
    CHECK(layout_difference("A{x:double,y:double}", "A{x:double,z:double}") ==
          R"x(the field "y" at the from end is "z" at the to end)x");
  }
  SECTION("which only one of them has") {
    CHECK(layout_difference("A{x:double}", "A{x:double,y:double}") ==
          R"x(the field "y" is only at the to end)x");
    CHECK(layout_difference("A{x:double,y:double}", "A{x:double}") ==
          R"x(the field "y" is only at the from end)x");
    CHECK(layout_difference("A{}", "A{x:double}") == R"x(the field "x" is only at the to end)x");
  }
  SECTION("in the type that they extend") {
    CHECK(layout_difference("Door:GoalPoint{x:double}", "Door{x:double,y:double}") ==
          "it extends GoalPoint at the from end and OrcaObject at the to end");
    CHECK(layout_difference("Door:GoalPoint{x:double}", "Door:GoalPoint{y:double}") ==
          R"x(the field "x" at the from end is "y" at the to end)x");
  }
  SECTION("deep inside") {
    CHECK(layout_difference(
              pose, "Odometry{stamp:TimeValue{ns:int64 {ns}},pose:Point{x:double {m},y:float {m}}}") ==
          R"x(the field "pose.y" is "double {m}" at the from end and "float {m}" at the to end)x");
    CHECK(
        layout_difference("A{p:sequence<P{x:double {m}}>}", "A{p:sequence<P{x:double {m},y:double {m}}>}") ==
        R"x(the field "p.y" is only at the to end)x");
  }
  SECTION("after a field whose type has commas of its own") {
    for (const std::string type : {"Mode(on,off)", "sequence<double,3>", "P{x:double,y:double}"}) {
      CAPTURE(type);
      CHECK(layout_difference("A{e:" + type + ",x:double}", "A{e:" + type + ",y:double}") ==
            R"x(the field "x" at the from end is "y" at the to end)x");
    }
  }
  SECTION("a struct of another name") {
    CHECK(layout_difference("A{p:P{x:double}}", "A{p:Q{x:double}}") ==
          R"x(the field "p" is "P{x:double}" at the from end and "Q{x:double}" at the to end)x");
  }
}

TEST_CASE("a layout that is damaged is compared as far as it goes", "[base][layout]") {
  for (const std::string damaged : {"", "A{", "A{x:", "A}x:{", "}", "x:", "A{x:double", "A{x:P{y:double}"}) {
    CAPTURE(damaged);
    CHECK_FALSE(layout_difference(damaged, "A{x:double}").empty());
    CHECK_FALSE(layout_difference("A{x:double}", damaged).empty());
  }
}
