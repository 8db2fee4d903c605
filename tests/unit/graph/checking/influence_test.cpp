// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings about parts that can have no effect.
#include "loading.hpp"

using namespace orca::graph;

namespace {

std::string said(const std::string& content, const std::string& ends = "") {
  return said_about("<graph name='g' ends='" + ends + "'>" + content + "</graph>");
}

}  // namespace

TEST_CASE("a component that nobody listens to is warned about, unless it works by itself",
          "[graph][influence]") {
  const auto avoid = [](const std::string& attributes) {
    return kSonarBase + "<component name='avoid' type='orca.SonarAvoid'" + attributes + "/>" + kSonarEdge;
  };
  CHECK(said(avoid("")).find("warning G051: component \"avoid\": nobody listens to what it pushes: motion") !=
        std::string::npos);
  CHECK(said(avoid(" autonomous='true'")).empty());
  CHECK(said(avoid(" watchable='true'")).empty());
  CHECK(said(avoid(""), "avoid").empty());
}

TEST_CASE("a component without ports has nothing to be connected to", "[graph][influence]") {
  CHECK(said("<component name='l' type='orca.Label'/>").empty());
}

TEST_CASE("a component that only answers queries is useful", "[graph][influence]") {
  CHECK(said(kSonarBase + "<component name='planner' type='orca.Planner' autonomous='true'/>"
                          "<connect from='planner.limits' to='base.LimitsQuery'/>")
            .empty());
}

TEST_CASE("a component that only asks is warned about: asking does not make it work", "[graph][influence]") {
  const auto planner = [](const std::string& attributes) {
    return kSonarBase + "<component name='planner' type='orca.Planner'" + attributes +
           "/><connect from='planner.limits' to='base.LimitsQuery'/>";
  };
  CHECK(said(planner(""))
            .find("warning G054: component \"planner\": it asks others, but nothing makes it work") !=
        std::string::npos);
  CHECK(said(planner(" autonomous='true'")).empty());
}

TEST_CASE("of a chain that nobody uses the end is warned about, and the rest is named there",
          "[graph][influence]") {
  const std::string chain =
      kSonarBase +
      "<component name='localizer' type='orca.Localizer'/><component name='goto' type='orca.Goto'" +
      "/><connect from='base.OdometryPush' to='localizer.odometry'/>"
      "<connect from='localizer.pose' to='goto.localizer'/>";
  const std::string text = said(chain);
  CHECK(
      text.find(
          "warning G051: component \"goto\": nobody listens to what it pushes: ArrivedPush, MotionPush; and "
          "what only it uses never works either: localizer, base;") != std::string::npos);
  CHECK(text.find("component \"localizer\"") == std::string::npos);
  CHECK(said(chain, "goto").empty());
}

TEST_CASE("components that only use each other are warned about once, unless one works by itself",
          "[graph][influence]") {
  const auto circle = [](const std::string& attributes) {
    return "<component name='a' type='orca.Relay'" + attributes +
           "/><component name='b' type='orca.Relay'/><component name='c' type='orca.Relay'/>"
           "<connect from='a.out' to='b.in'/><connect from='b.out' to='a.in'/><connect from='c.out' "
           "to='a.in'/><connect from='b.out' to='c.in'/>";
  };
  const std::string text = said(circle(""));
  CHECK(text.find(
            "warning G055: component \"a\": these only use each other, so none of them begins to work: a, b, "
            "c;") != std::string::npos);
  CHECK(text.find("G055") == text.rfind("G055"));
  CHECK(said(circle(" autonomous='true'")).empty());
}

TEST_CASE("a component that sends may have a reason of its own to work", "[graph][influence]") {
  const std::string command =
      kSonarBase +
      "<component name='command' type='orca.Command'/><component name='fuser' "
      "type='orca.MotionCommandFuser'/><component name='walk' type='orca.TwinGoto'/>"
      "<connect from='walk.slow' to='fuser.motion'/><connect from='fuser.base' to='base.MotionCommandSend'/>";
  CHECK(said(command + "<connect from='command.clients' to='fuser.ClientListSend'/>").empty());
}

TEST_CASE("a fuser without behaviours is warned about, by the author's name of the port",
          "[graph][influence]") {
  const auto fuser = [](const std::string& port) {
    return kSonarBase + "<component name='fuser' type='orca.MotionCommandFuser'>" + port +
           "</component><connect from='fuser.base' to='base.MotionCommandSend'/>";
  };
  CHECK(said(fuser("")).find(
            "warning G056: component \"fuser\": its port \"motion\" collects MotionCommand from any "
            "number of components, and none is connected") != std::string::npos);
  CHECK(said(fuser("<port name='motion' as='wishes'/>"))
            .find("its port \"wishes\" collects MotionCommand from any number of components, and none is "
                  "connected; "
                  "connect some, or say that it is not used: <port name=\"motion\" disabled=\"true\"/>") !=
        std::string::npos);
  CHECK(said(fuser("<port name='motion' disabled='true'/>")).empty());
}

TEST_CASE("a component that listens to something else may have nothing to collect", "[graph][influence]") {
  const std::string avoid =
      kSonarBase + "<component name='avoid' type='orca.TwoRingAvoid' autonomous='true'/>";
  CHECK(said(avoid + kSonarEdge).empty());
}

TEST_CASE("warnings about influence wait until there are no errors", "[graph][influence]") {
  const std::string all = said(kSonarBase + "<component name='a' type='orca.Localizer' priority='1000'/>");
  CHECK(all.find("G032") != std::string::npos);
  CHECK(all.find("G051") == std::string::npos);
}

TEST_CASE("with --strict all warnings are errors, and all are reported", "[graph][influence]") {
  orca::xml::Diagnostics diagnostics;
  LoadOptions strict;
  strict.strict = true;
  const Files files{{"main.xml",
                     "<graph name='g'><arg name='x' default='1'/><component name='a' "
                     "type='orca.Localizer'/></graph>"}};
  CHECK_FALSE(load_files(files, diagnostics, strict).has_value());
  CHECK(diagnostics.error_count() == 2);
  CHECK(diagnostics.text().find("warning") == std::string::npos);
}
