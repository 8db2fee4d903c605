// SPDX-License-Identifier: GPL-3.0-or-later
// What a component's configure() refuses is an error of the graph.
#include <catch2/catch.hpp>

#include "loading.hpp"

using Catch::Contains;

namespace {

using Names = std::vector<std::string>;

std::string said_of(const std::string& content,
                    const orca::graph::LoadOptions& options = {.try_components = true}) {
  return said_about("<graph name='demo'>\n" + content + "</graph>", options);
}

// Returns the components whose configure() was called, in order, with a "?" behind those in doubt.
Names tried(const std::string& content) {
  FakeCatalogue catalogue;
  orca::xml::Diagnostics diagnostics;
  (void)orca::graph::load_text("<graph name='demo'>" + content + "</graph>", "test.xml",
                               {.try_components = true}, catalogue, diagnostics);
  Names names;
  for (const std::string& call : catalogue.calls)
    if (call.starts_with("try ")) {
      names.push_back(call.substr(4));
    } else if (call.starts_with("doubt ")) {
      names.push_back(call.substr(6) + "?");
    }
  return names;
}

const std::string kAvoider =
    "<hardware name='robot' type='orca.hw.Sim'/><component name='base' type='orca.RobotBaseServer' "
    "hardware='robot'/>"
    "<component name='avoid' type='orca.SonarAvoid'/><connect from='base.SonarRangeReadingsPush' "
    "to='avoid.sonar'/>";

}  // namespace

TEST_CASE("what a component refuses is reported at the value of the parameter that it names",
          "[graph][configuration]") {
  CHECK_THAT(said_of("<component name='a' type='orca.Label' autonomous='true'>\n"
                     "  <param name='label' value='torn'/>\n</component>\n"),
             Contains("test.xml:3:30: error G062: component \"a\": parameter \"label\": nobody can read it"));
}

TEST_CASE("what a component refuses without naming a parameter is reported at the component",
          "[graph][configuration]") {
  CHECK_THAT(said_of("  <component name='a' type='orca.Label' autonomous='true'>\n"
                     "    <param name='label' value='lost'/>\n</component>\n"),
             Contains("test.xml:2:3: error G062: component \"a\": configure() ended the process"));
}

TEST_CASE("all components are tried, whatever else is wrong with the graph", "[graph][configuration]") {
  const std::string said = said_of(
      "<component name='a' type='orca.Label'><param name='label' value='torn'/></component>\n"
      "<component name='b' type='orca.Label'><param name='label' value='torn'/></component>\n"
      "<component name='c' type='orca.Lable'/>\n");
  CHECK_THAT(said, Contains("test.xml:2:") && Contains("test.xml:3:") && Contains("test.xml:4:"));
  CHECK_THAT(said, Contains("G027"));
}

TEST_CASE("without being asked for, nothing is tried", "[graph][configuration]") {
  CHECK(said_of("<component name='a' type='orca.Label'><param name='label' value='torn'/></component>", {})
            .empty());
}

TEST_CASE("components are tried in the order in which they come up", "[graph][configuration]") {
  CHECK(tried("<component name='a' type='orca.Label' start_after='b'/><component name='b' type='orca.Label'/>"
              "<component name='c' type='orca.Label'/>") == Names{"b", "c", "a"});
}

TEST_CASE("a component with an error of its own is not tried, and what comes up after it is in doubt",
          "[graph][configuration]") {
  CHECK(
      tried(
          "<component name='a' type='orca.Label'><param name='labl' value='x'/></component>"
          "<component name='b' type='orca.Label' start_after='a'/><component name='c' type='orca.Label'/>") ==
      Names{"c", "b?"});
  CHECK(tried("<component name='a' type='orca.Label' start_after='b'/>"
              "<component name='b' type='orca.Label' start_after='a'/>") == Names{"a?", "b?"});
  CHECK(tried("<component name='a' type='orca.Label' start_after='nobody'/>") == Names{"a?"});
}

TEST_CASE("a component whose connection is wrong is in doubt: what it refuses may follow from that",
          "[graph][configuration]") {
  const std::string fuser = "<component name='fuser' type='orca.MotionCommandFuser'/>";
  CHECK(tried(kAvoider) == Names{"base", "avoid"});
  CHECK(tried(kAvoider + fuser + "<connect from='avoid.motoin' to='fuser.motion'/>") ==
        Names{"base", "avoid?", "fuser?"});
  // The misspelt component may be the avoider, but not the base, which pushes no commands.
  CHECK(tried(kAvoider + fuser + "<connect from='aviod.motion' to='fuser.motion'/>") ==
        Names{"base", "avoid?", "fuser?"});
  CHECK(tried(kAvoider + fuser + "<connect from='avoid.motion' to='fuser.motion' queue='many'/>") ==
        Names{"base", "avoid?", "fuser?"});
}

TEST_CASE("a component that is given hardware which it does not take is tried all the same",
          "[graph][configuration]") {
  CHECK(tried(kAvoider + "<component name='fuser' type='orca.MotionCommandFuser' hardware='nothing'/>"
                         "<connect from='avoid.motion' to='fuser.motion'/>") ==
        Names{"base", "avoid", "fuser"});
}

TEST_CASE("components of the hardware that is wrong are not tried, and those behind them are in doubt",
          "[graph][configuration]") {
  std::string drowned = kAvoider;
  const std::string hardware = "<hardware name='robot' type='orca.hw.Sim'/>";
  drowned.replace(0, hardware.size(),
                  "<hardware name='robot' type='orca.hw.Sim'><param name='world' "
                  "value='flooded.world'/></hardware>");
  CHECK(tried(drowned) == Names{"avoid?"});
}
