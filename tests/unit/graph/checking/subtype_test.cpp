// SPDX-License-Identifier: GPL-3.0-or-later
// Connections whose ends name different types, of which one extends the other.
#include "loading.hpp"

using namespace orca::graph;
using Catch::Contains;

namespace {

std::string with_base(const std::string& content) {
  return "<graph name='g'><hardware name='robot' type='orca.hw.Sim'/>"
         "<component name='base' type='orca.RobotBaseServer' hardware='robot'/>" +
         content + "</graph>";
}

std::string with_goto(const std::string& content) {
  return "<graph name='g'><component name='localizer' type='orca.Localizer'/>"
         "<component name='goto' type='orca.Goto'/>"
         "<connect from='localizer.pose' to='goto.localizer'/>" +
         content + "</graph>";
}

}  // namespace

TEST_CASE("a port takes objects of a type that extends its own", "[graph][subtype]") {
  CHECK(must_load(with_base("<component name='viewer' type='orca.RangeViewer'/>"
                            "<connect from='base.SonarRangeReadingsPush' to='viewer.ranges'/>"))
            .edges.size() == 1);
  CHECK(must_load(with_goto("<component name='porter' type='orca.Porter'/>"
                            "<connect from='porter.door' to='goto.GoalSend'/>"))
            .edges.size() == 2);
}

TEST_CASE("a port takes no objects of a type that its own extends", "[graph][subtype]") {
  const std::string said = said_about(
      "<graph name='g'><component name='command' type='orca.Command'/>"
      "<component name='porter' type='orca.Porter'/><connect from='command.goal' "
      "to='porter.DoorSend'/></graph>");
  CHECK_THAT(said,
             Contains("error G021") && Contains("the object that comes is GoalPoint, but Door is expected") &&
                 Contains("their nearest common type is GoalPoint, and a GoalPoint need not be a Door"));
}

TEST_CASE("types with a common parent do not fit, and the error names it", "[graph][subtype]") {
  const std::string said =
      said_about(with_base("<component name='avoid' type='orca.LaserAvoid'/>"
                           "<connect from='base.SonarRangeReadingsPush' to='avoid.laser'/>"));
  CHECK_THAT(said,
             Contains("error G021") &&
                 Contains("the object that comes is SonarRangeReadings, but LaserRangeReadings is expected; "
                          "their nearest common type is RangeReadings"));
}

TEST_CASE("a parent that has another layout at the other end does not fit", "[graph][subtype]") {
  const std::string said =
      said_about(with_base("<component name='viewer' type='orca.OldRangeViewer'/>"
                           "<connect from='base.SonarRangeReadingsPush' to='viewer.ranges'/>"));
  CHECK_THAT(said,
             Contains("error G022") && Contains("both ends call the object RangeReadings, but the field "
                                                "\"ranges\" is \"sequence<double> {m}\" at the from end"));
}

TEST_CASE("what is offered to a port that is not connected includes subtypes", "[graph][subtype]") {
  CHECK_THAT(said_about(with_base("<component name='viewer' type='orca.RangeViewer'/>")),
             Contains("error G025") && Contains("it is offered by: base.SonarRangeReadingsPush"));
}

TEST_CASE("a required port that gives a subtype is offered the ports of its parent", "[graph][subtype]") {
  CHECK_THAT(said_about(with_goto("<component name='guide' type='orca.Guide'/>")),
             Contains("\"guide\": port \"door\" (SendProxy of Door)") &&
                 Contains("it is offered by: goto.GoalSend"));
}

TEST_CASE("a candidate may offer a subtype", "[graph][subtype]") {
  const Graph graph =
      must_load(with_base("<component name='viewer' type='orca.RangeCollector'><port name='ranges' "
                          "candidates='base'/></component>"));
  CHECK(graph.edges.at(0).from.text() == "base.SonarRangeReadingsPush");
}

TEST_CASE("a misspelt end explains why a port of the parent's type is not connected", "[graph][subtype]") {
  const std::string said =
      said_about(with_base("<component name='viewer' type='orca.RangeViewer'/>"
                           "<connect from='base.SonarRangeReadingsPush' to='vewer.ranges'/>"));
  CHECK_THAT(said, Contains("vewer") && !Contains("must be connected"));
}
