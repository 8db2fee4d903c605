// SPDX-License-Identifier: GPL-3.0-or-later
#include "loading.hpp"

using namespace orca::graph;

TEST_CASE("the catalogue is given the folders first, then the hardware, then the components",
          "[graph][catalogue]") {
  FakeCatalogue catalogue;
  orca::xml::Diagnostics diagnostics;
  const auto graph = load_text(
      "<graph name='g' plugins='/opt/more'><component name='base' type='orca.RobotBaseServer' "
      "hardware='robot'/>"
      "<component name='loc' type='orca.Localizer'/><hardware name='robot' type='orca.hw.Sim'/></graph>",
      "g.xml", {}, catalogue, diagnostics);
  CHECK(graph.has_value());
  CHECK(catalogue.calls ==
        std::vector<std::string>{"folders /opt/more", "hardware orca.hw.Sim", "validate robot",
                                 "component orca.RobotBaseServer with robot", "component orca.Localizer"});
}

TEST_CASE("hardware with a wrong parameter is looked into all the same, with the default in its place",
          "[graph][catalogue]") {
  const std::string said = said_about(
      "<graph name='g'>\n<hardware name='robot' type='orca.hw.Sim'>\n<param name='realism' value='no'/>\n"
      "<param name='world' value='flooded.world'/></hardware></graph>");
  CHECK_THAT(said, Catch::Contains("test.xml:3:30: error G033"));
  CHECK_THAT(said, Catch::Contains("test.xml:4:28: error G042: hardware \"robot\": parameter \"world\""));
}

TEST_CASE("hardware of an unknown type, or with an error, is shown to no component", "[graph][catalogue]") {
  for (const char* hardware :
       {"<hardware name='robot' type='orca.hw.Sam'/>",
        "<hardware name='robot' type='orca.hw.Sim'><param name='wrld' value='x'/></hardware>",
        "<hardware name='robot' type='orca.hw.Deep'/>"}) {
    INFO(hardware);
    FakeCatalogue catalogue;
    orca::xml::Diagnostics diagnostics;
    (void)load_text(std::string("<graph name='g'>") + hardware +
                        "<component name='base' type='orca.RobotBaseServer' hardware='robot'/></graph>",
                    "g.xml", {}, catalogue, diagnostics);
    CHECK(diagnostics.error_count() == 1);
    CHECK(catalogue.calls.back() == "component orca.RobotBaseServer");
  }
}

TEST_CASE("what hardware says of a default that stands for a wrong value is not reported",
          "[graph][catalogue]") {
  const auto said = [](const std::string& params) {
    return said_about("<graph name='g'><hardware name='robot' type='orca.hw.Deep'>" + params +
                      "</hardware></graph>");
  };
  CHECK_THAT(said(""), Catch::Contains("G042") && Catch::Contains("the sea is 0 m deep"));
  // The fault stands at "ship" and follows from "depth".
  for (const char* wrong : {"<param name='depth' value='much'/>", "<param name='depth'/>",
                            "<param name='dept' value='3'/>", "<param name='depth' value='${depth}'/>"}) {
    INFO(wrong);
    CHECK_THAT(said(wrong), !Catch::Contains("G042"));
    CHECK_THAT(said(wrong), Catch::Contains("error G"));
  }
  CHECK_THAT(said("<param name='ship' value='ark'/><param name='dept' value='3'/>"),
             !Catch::Contains("G042"));
  CHECK_THAT(said("<param name='depth' value='0'/><param name='shp' value='ark'/>"),
             !Catch::Contains("G042"));
  CHECK_THAT(
      said("<param name='depth' value='0'/><param name='ship' value='ark'/><param name='x' value='1'/>"),
      Catch::Contains("G042") && Catch::Contains("G029"));
}

TEST_CASE("errors in a world file are printed in the simulator's words", "[graph][catalogue]") {
  const std::string said = said_about(
      "<graph name='g'><hardware name='robot' type='orca.hw.Sim'><param name='world' value='broken.world'/>"
      "</hardware></graph>");
  CHECK(
      said ==
      "broken.world:4:3: error W001: two walls cross\nbroken.world:9:3: error W002: the floor has no size\n");
}

TEST_CASE("a value that the hardware refuses is reported where the graph sets it", "[graph][catalogue]") {
  const std::string said = said_about(
      "<graph name='g'>\n<hardware name='robot' type='orca.hw.Sim'>\n<param name='world' "
      "value='flooded.world'/>"
      "</hardware></graph>");
  CHECK(said ==
        "test.xml:3:28: error G042: hardware \"robot\": parameter \"world\": it is under water; take "
        "another\n");
}

TEST_CASE(
    "two hardware containers that cannot both be are told at the second, where the graph sets the value",
    "[graph][catalogue]") {
  const auto scout = [](const std::string& name, const std::string& port) {
    return "<hardware name='" + name + "' type='orca.hw.NomadScout'>\n<param name='port' value='" + port +
           "'/></hardware>\n";
  };
  CHECK_THAT(said_about("<graph name='g'>\n" + scout("one", "/dev/a") + scout("two", "/dev/b") + "</graph>"),
             !Catch::Contains("error"));
  CHECK_THAT(
      said_about("<graph name='g'>\n" + scout("one", "/dev/a") + scout("two", "/dev/a") + "</graph>"),
      Catch::Contains("test.xml:5:27: error G042: hardware \"two\": parameter \"port\": hardware \"one\" is "
                      "on this port already"));
}
