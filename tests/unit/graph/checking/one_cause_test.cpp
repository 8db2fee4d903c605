// SPDX-License-Identifier: GPL-3.0-or-later
// One mistake gives one error: its consequences are not reported as well. It hides nothing that has another
// cause.
#include <set>

#include "loading.hpp"

namespace {

std::multiset<std::string> codes(const std::string& text) {
  FakeCatalogue catalogue;
  orca::xml::Diagnostics diagnostics;
  (void)orca::graph::load_text(text, "test.xml", {}, catalogue, diagnostics);
  UNSCOPED_INFO(diagnostics.text());
  std::multiset<std::string> result;
  for (const auto& diagnostic : diagnostics.sorted()) result.insert(diagnostic.code);
  return result;
}

using Codes = std::multiset<std::string>;

const std::string kAutonomousAvoid = "<component name='avoid' type='orca.SonarAvoid' autonomous='true'/>";

std::string graph_with_content(const std::string& content) {
  return "<graph name='g'>" + content + "</graph>";
}

}  // namespace

TEST_CASE("the parts of these tests are good", "[graph][one cause]") {
  CHECK(codes(graph_with_content(kSonarBase + kAutonomousAvoid + kSonarEdge)).empty());
}

TEST_CASE("an unknown type says nothing about the ports of the component", "[graph][one cause]") {
  CHECK(codes(graph_with_content(kSonarBase + "<component name='avoid' type='orca.Sonar'/>" + kSonarEdge +
                                 "<connect from='avoid.x' to='base.MotionCommandSend'/>")) == Codes{"G027"});
}

TEST_CASE("a misspelt required port is not also reported as missing", "[graph][one cause]") {
  CHECK(codes(graph_with_content(kSonarBase + kAutonomousAvoid +
                                 "<connect from='base.SonarRangeReadingsPush' to='avoid.sonnar'/>")) ==
        Codes{"G017"});
  CHECK(codes(graph_with_content(kSonarBase + kAutonomousAvoid +
                                 "<connect from='base.SonarRangeReadingsPush' to='avoid.in'/>")) ==
        Codes{"G017"});
  CHECK(codes(graph_with_content(kSonarBase + kAutonomousAvoid +
                                 "<connect from='base.SonarRangeReadingsPush' to='ovoid.sonar'/>")) ==
        Codes{"G016"});
  CHECK(codes(graph_with_content(kSonarBase + kAutonomousAvoid +
                                 "<connect from='base.SonarRangeReadingsPush'/>")) == Codes{"G007"});
  CHECK(codes(graph_with_content(kSonarBase + kAutonomousAvoid +
                                 "<connect from='base.OdometryPush' to='avoid.sonar'/>")) == Codes{"G021"});
}

TEST_CASE("a connection with a bad policy does not take the place of another one, whichever attribute is bad",
          "[graph][one cause]") {
  const std::string second =
      "<hardware name='robot2' type='orca.hw.Sim'/><component name='base2' type='orca.RobotBaseServer' "
      "hardware='robot2'/><connect from='base2.SonarRangeReadingsPush' to='avoid.sonar'/>";
  const auto with = [&](const std::string& policy) {
    return codes(graph_with_content(kSonarBase + kAutonomousAvoid +
                                    "<connect from='base.SonarRangeReadingsPush' to='avoid.sonar'" + policy +
                                    "/>" + second));
  };
  CHECK(with("") == Codes{"G023"});
  for (const std::string policy :
       {"queue='many'", "overflow='some'", "interval='often'", "deadline='soon'",
        "interval='2 s' deadline='1 s'", "block_limit='1 s'", "confirm='handled'"}) {
    CAPTURE(policy);
    const Codes found = with(" " + policy);
    CHECK(found.size() == 1);
    CHECK(found.count("G023") == 0);
  }
}

TEST_CASE("a misspelt element or attribute is taken for what it was meant to be", "[graph][one cause]") {
  CHECK(codes(graph_with_content(kSonarBase + "<componet name='avoid' type='orca.SonarAvoid'/>" +
                                 kSonarEdge)) == Codes{"G003"});
  CHECK(codes(graph_with_content(kSonarBase + "<component nmae='avoid' type='orca.SonarAvoid'/>" +
                                 kSonarEdge)) == Codes{"G006"});
  CHECK(codes(graph_with_content(kSonarBase + kAutonomousAvoid +
                                 "<conect from='base.SonarRangeReadingsPush' to='avoid.sonar'/>")) ==
        Codes{"G003"});
  CHECK(codes(graph_with_content(kSonarBase + kAutonomousAvoid +
                                 "<edge from='base.SonarRangeReadingsPush' to='avoid.sonar'/>")) ==
        Codes{"G003"});
}

TEST_CASE("a name that an unknown element has is not reported as missing", "[graph][one cause]") {
  CHECK(codes(graph_with_content(kSonarBase + "<node name='avoid'/>" + kSonarEdge)) == Codes{"G003"});
  CHECK(codes("<graph name='g' ends='x'><component name='a' type='orca.Localizer' start_after='x'/>"
              "<node name='x'/></graph>") == Codes{"G003"});
}

TEST_CASE("an include that is not found may hold anything, but a name that nearly fits is still an error",
          "[graph][one cause]") {
  CHECK(codes(graph_with_content(
            kSonarBase +
            "<include file='more.xml'/><connect from='base.SonarRangeReadingsPush' to='far.sonar'/>")) ==
        Codes{"G043"});
  CHECK(codes(graph_with_content(
            kSonarBase +
            "<include file='more.xml'/><connect from='bose.SonarRangeReadingsPush' to='far.sonar'/>")) ==
        Codes{"G016", "G043"});
}

TEST_CASE("a file that is missing is one error, whatever would have been in it", "[graph][one cause]") {
  CHECK(codes("<graph name='g' default_profile='sim' ends='command'><include file='more.xml'/>"
              "<component name='base' type='orca.RobotBaseServer' hardware='robot'/>" +
              kAutonomousAvoid + "<component name='l' type='orca.Localizer' start_after='other'/></graph>") ==
        Codes{"G043"});
}

TEST_CASE("broken hardware says nothing about the components bound to it", "[graph][one cause]") {
  const std::string rest =
      "<component name='base' type='orca.RobotBaseServer' hardware='robot'/>" + kAutonomousAvoid + kSonarEdge;
  CHECK(codes(graph_with_content("<hardware name='robot' type='orca.hw.Sin'/>" + rest)) == Codes{"G027"});
  CHECK(codes(graph_with_content("<hardware name='robot'/>" + rest)) == Codes{"G007"});
  CHECK(codes(graph_with_content(
            "<hardware name='robot' type='orca.hw.Sim'><param name='realism' value='no'/></hardware>" +
            rest)) == Codes{"G033"});
  CHECK(codes(graph_with_content(rest)) == Codes{"G034"});
}

TEST_CASE("a component without its hardware is not asked for its ports", "[graph][one cause]") {
  CHECK(codes(graph_with_content("<component name='base' type='orca.RobotBaseServer'/>" + kAutonomousAvoid +
                                 kSonarEdge)) == Codes{"G035"});
}

TEST_CASE("a value that cannot be known is not judged", "[graph][one cause]") {
  CHECK(codes(graph_with_content(
            kSonarBase + "<component name='avoid' type='orca.SonarAvoid' period='${x}' priority='3'/>" +
            kSonarEdge)) == Codes{"G011"});
  CHECK(
      codes(graph_with_content(
          "<arg name='x'/>" + kSonarBase +
          "<component name='avoid' type='orca.SonarAvoid'><param name='samples' value='${x}'/></component>" +
          kSonarEdge)) == Codes{"G012"});
  CHECK(codes(graph_with_content(kSonarBase + kAutonomousAvoid +
                                 "<connect from='base.SonarRangeReadingsPush' to='${x}.sonar'/>")) ==
        Codes{"G011"});
  CHECK(codes(graph_with_content(kSonarBase + "<component name='&who;' type='orca.Localizer'/>" +
                                 kAutonomousAvoid + kSonarEdge)) == Codes{"G117"});
}

TEST_CASE("a component without a name may be the one that is referred to", "[graph][one cause]") {
  for (const char* name : {"", "name=''", "name='${who}'"}) {
    const std::string component = "<component " + std::string(name) + " type='orca.SonarAvoid'/>";
    CHECK(codes(graph_with_content(kSonarBase + component + component + kSonarEdge)).size() == 2);
  }
}

TEST_CASE("a bad name can still be referred to", "[graph][one cause]") {
  CHECK(codes(graph_with_content(kSonarBase +
                                 "<component name='my-avoid' type='orca.SonarAvoid'/>"
                                 "<connect from='base.SonarRangeReadingsPush' to='my-avoid.sonar'/>")) ==
        Codes{"G009"});
}

TEST_CASE("a profile that is not there may hold anything", "[graph][one cause]") {
  CHECK(codes("<graph name='g' default_profile='hall'>" + kAutonomousAvoid +
              "<component name='base' type='orca.RobotBaseServer' hardware='robot'/>" + kSonarEdge +
              "<profile name='hal'><hardware name='robot' type='orca.hw.Sim'/></profile></graph>") ==
        Codes{"G015"});
}

TEST_CASE("a broken plugin is reported once, however many components need it", "[graph][one cause]") {
  CHECK(codes(graph_with_content(
            "<component name='a' type='orca.Broken'/><component name='b' type='orca.Broken'/>")) ==
        Codes{"G028"});
}

TEST_CASE("an unknown element hides neither wiring nor parameter errors", "[graph][one cause]") {
  CHECK(codes(graph_with_content(
            "<plotter/>" + kSonarBase +
            "<component name='avoid' type='orca.SonarAvoid'><param name='samples' value='0'/>"
            "</component><connect from='base.OdometryPush' to='avoid.sonar'/>")) ==
        Codes{"G003", "G021", "G032"});
}

TEST_CASE("a duplicate component is checked like any other", "[graph][one cause]") {
  CHECK(
      codes(graph_with_content(
          kSonarBase + kAutonomousAvoid + kSonarEdge +
          "<component name='avoid' type='orca.SonarAvoid'><param name='samples' value='0'/></component>")) ==
      Codes{"G010", "G032"});
}

TEST_CASE("a text that is shown in part is not cut within a character", "[graph][one cause]") {
  const std::string said = said_about(graph_with_content(
      "<component name='l' type='orca.Label'>nineteen characters\u00e4\u00f6</component>"));
  CHECK(said.find("the text \"nineteen characters...\" inside") != std::string::npos);
}

TEST_CASE("two circles of start_after are two errors", "[graph][one cause]") {
  const auto after = [](const char* name, const char* before) {
    return "<component name='" + std::string(name) + "' type='orca.Localizer' start_after='" + before + "'/>";
  };
  CHECK(codes(graph_with_content(after("a", "b") + after("b", "a") + after("c", "d") + after("d", "c") +
                                 after("e", "a c"))) == Codes{"G037", "G037"});
}
