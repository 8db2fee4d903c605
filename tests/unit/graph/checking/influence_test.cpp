// SPDX-License-Identifier: GPL-3.0-or-later
// Warnings about parts that can have no effect.
#include "loading.hpp"

using namespace orca::graph;

namespace {

const std::string kBase =
    "<hardware name='robot' type='orca.hw.Sim'/><component name='base' type='orca.RobotBaseServer' "
    "hardware='robot'/>";
const std::string kEdge = "<connect from='base.SonarRangeReadingsPush' to='avoid.sonar'/>";

std::string said(const std::string& content, const std::string& ends = "") {
  return said_about("<graph name='g' ends='" + ends + "'>" + content + "</graph>");
}

}  // namespace

TEST_CASE("a component that nobody listens to is warned about, unless it works by itself",
          "[graph][influence]") {
  const auto avoid = [](const std::string& attributes) {
    return kBase + "<component name='avoid' type='orca.SonarAvoid'" + attributes + "/>" + kEdge;
  };
  CHECK(said(avoid("")).find("warning G051: component \"avoid\": nobody listens to what it pushes: motion") !=
        std::string::npos);
  CHECK(said(avoid(" autonomous='true'")).empty());
  CHECK(said(avoid(""), "avoid").empty());
}

TEST_CASE("a component without ports has nothing to be connected to", "[graph][influence]") {
  CHECK(said("<component name='l' type='orca.Label'/>").empty());
}

TEST_CASE("a component that only answers queries is useful", "[graph][influence]") {
  CHECK(said(kBase + "<component name='planner' type='orca.Planner'/>"
                     "<connect from='planner.limits' to='base.LimitsQuery'/>")
            .empty());
}

TEST_CASE("warnings about influence wait until there are no errors", "[graph][influence]") {
  const std::string all = said(kBase + "<component name='a' type='orca.Localizer' priority='1000'/>");
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
