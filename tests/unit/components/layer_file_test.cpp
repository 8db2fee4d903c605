// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/planning/layer_file.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <string>

#include "temp_folder.hpp"

using namespace orca;
using Catch::Contains;

namespace {

Result<nav::FloorRules> layer_of(const test::TempFolder& folder, const std::string& content) {
  return planning::read_layer(
      folder.write("layer.xml", "<layer name=\"rules\" version=\"1\">\n" + content + "\n</layer>"));
}

}  // namespace

TEST_CASE("a layer has zones to keep out of, slow zones and lanes", "[layer]") {
  const test::TempFolder folder;
  const auto rules = layer_of(folder, R"(<keep_out name="glass" from="4 5" to="2 1"/>
<slow name="hall" from="0 0" to="10 10" speed="30 cm/s"/>
<lane name="north" from="1 1" to="1 9" width="0.8 m" one_way="true"/>)");
  REQUIRE(rules);
  REQUIRE(rules->zones().size() == 3);
  CHECK(rules->zones()[0].holds({2.1, 4.9}));
  CHECK_FALSE(rules->zones()[0].holds({1.9, 4.9}));
  CHECK(*rules->speed_at({9.0, 9.0}) == Approx(0.3));
  CHECK(rules->zones()[2].one_way);
  CHECK(rules->zones()[2].middle.yaw == Approx(std::numbers::pi / 2.0));
  CHECK(rules->zones()[2].holds({1.3, 5.0}));
  CHECK_FALSE(rules->zones()[2].holds({1.5, 5.0}));
}

TEST_CASE("all that is wrong with a layer is reported at once, with line and column", "[layer]") {
  const test::TempFolder folder;
  const auto rules = layer_of(folder, R"(<keep_out name="glass" from="4 five" to="2 1"/>
<slow name="hall" from="0 0" to="10 10"/>
<slow name="2nd" from="0 0" to="10 10" speed="-1 m/s"/>
<lane name="north" from="1 1" to="1 1" width="0.8 m"/>
<lane name="south" from="1 1" to="1 9" width="0.8 m" oneway="true"/>
<keepout name="x" from="0 0" to="1 1"/>)");
  REQUIRE_FALSE(rules);
  const std::string& text = rules.error().message;
  CHECK_THAT(text, Contains("layer.xml:2:") && Contains("L005"));
  CHECK_THAT(text, Contains("layer.xml:3:") && Contains("L004") && Contains("\"speed\""));
  CHECK_THAT(text, Contains("layer.xml:4:"));
  CHECK_THAT(text, Contains("layer.xml:5:35") && Contains("L008") && Contains("has no area"));
  CHECK_THAT(text, Contains("layer.xml:6:") && Contains("L003") && Contains("\"one_way\""));
  CHECK_THAT(text, Contains("layer.xml:7:") && Contains("L002") && Contains("keep_out"));
}

TEST_CASE("another file, another version and no file are refused with what was expected", "[layer]") {
  const test::TempFolder folder;
  CHECK_THAT(planning::read_layer(folder.write("a.xml", "<world name=\"a\" version=\"1\"/>")).error().message,
             Contains("L001") && Contains("<layer name="));
  CHECK_THAT(planning::read_layer(folder.write("b.xml", "<layer name=\"a\" version=\"2\"/>")).error().message,
             Contains("L009") && Contains("version \"1\""));
  CHECK_FALSE(planning::read_layer((folder.path() / "none.xml").string()));
}
