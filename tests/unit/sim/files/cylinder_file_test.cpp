// SPDX-License-Identifier: GPL-3.0-or-later
// Worlds of cylinders in one CSV file. The BARN worlds themselves are not part of this repository.
#include <catch2/catch.hpp>

#include "orca/sim/caster.hpp"
#include "orca/sim/world_file.hpp"
#include "public_data.hpp"
#include "temp_folder.hpp"

using namespace orca::sim;
using orca::Pose2;
using orca::Vec2;
using orca::test::TempFolder;

namespace {

constexpr const char* kTwoWorlds = "world,x,y\r\n1,-1.0,6.0\r\n1,-2.0,7.0\r\n5,-3.5,8.0\r\n";

std::string errors_of_file(const std::string& path, const BitmapScale& scale = {}) {
  orca::xml::Diagnostics diagnostics;
  CHECK_FALSE(read_world(path, scale, diagnostics).has_value());
  return diagnostics.text();
}

}  // namespace

TEST_CASE("a file of many worlds gives the requested one", "[sim][cylinders]") {
  const TempFolder folder;
  orca::xml::Diagnostics diagnostics;
  const auto world = read_world(folder.write("two.csv", kTwoWorlds) + "#1", {}, diagnostics);
  INFO(diagnostics.text());
  REQUIRE(world);
  CHECK(world->name == "two");
  REQUIRE(world->obstacles.size() == 2);
  CHECK(std::get<Circle>(world->obstacles[1].shape) == Circle{{-2.0, 7.0}, 0.075});
  REQUIRE(world->place("start") != nullptr);
  CHECK(world->place("start")->pose == Pose2{-2.25, 3.0, 0.5 * std::numbers::pi});
  CHECK(world->place("goal")->pose.position() == Vec2{-2.25, 13.0});
}

TEST_CASE("without a number the error says which worlds the file holds", "[sim][cylinders]") {
  const TempFolder folder;
  const std::string path = folder.write("two.csv", kTwoWorlds);
  CHECK(errors_of_file(path) ==
        path + ": error W017: the file holds 2 worlds, numbered from 1 to 5; choose one: \"" + path +
            "#1\"\n");
  CHECK_THAT(errors_of_file(path + "#3"),
             Catch::Contains("there is no world 3") && Catch::Contains("did you mean 5?"));
  CHECK_THAT(errors_of_file(path + "#first"), Catch::Contains("\"#first\" does not choose a world"));
  CHECK_THAT(errors_of_file(path + "#"), Catch::Contains("W017"));
  CHECK_THAT(errors_of_file(path + "#1", {10.0, {}}),
             Catch::Contains("error W013: map_width is for bitmaps"));
}

TEST_CASE("worlds that hold nothing to choose from refuse a number", "[sim][cylinders]") {
  CHECK_THAT(
      errors_of_file(ORCA_SOURCE_DIR "/sim/worlds/office.xml#2"),
      Catch::Contains("error W017: \"#2\" is the seed of what is generated, but nothing in this world is"));
  CHECK_THAT(errors_of_file("map.png#2", {10.0, {}}), Catch::Contains("W017: a picture holds one world"));
}

TEST_CASE("a packed file that is damaged or missing is reported", "[sim][cylinders]") {
  const TempFolder folder;
  const std::string head("\x1f\x8b\x08\0\0\0\0\0\0\x03", 10);
  CHECK_THAT(errors_of_file(folder.write("cut.csv.gz", head) + "#1"),
             Catch::Contains("error W011: cannot read the file"));
  CHECK_THAT(errors_of_file(folder.write("bad.csv.gz", head + "nonsense") + "#1"),
             Catch::Contains("error W011"));
  CHECK_THAT(errors_of_file(folder.write("empty.csv.gz", "") + "#1"), Catch::Contains("the file is empty"));
  CHECK_THAT(errors_of_file("/no/such.csv.gz#1"), Catch::Contains("No such file or directory"));
}

TEST_CASE("BARN worlds are read and start free between their walls", "[sim][cylinders][data]") {
  const std::string file = orca::test::public_data("barn/cylinders.csv.gz");
  if (file.empty()) return;
  std::size_t worlds = 0;
  for (int number = 1; number < 300; number += 10) {
    orca::xml::Diagnostics diagnostics;
    const auto world = read_world(file + "#" + std::to_string(number), {}, diagnostics);
    if (!world) continue;
    ++worlds;
    CAPTURE(number);
    CHECK(world->obstacles.size() > 156);  // The walls alone.
    CHECK(world->obstacle_at(Circle{{-2.25, 3.0}, 1.5}, 0.0) == nullptr);
    CHECK(world->obstacle_at(Circle{{-2.25, 13.0}, 1.5}, 0.0) == nullptr);
    const Caster caster(*world);
    const auto range = [&](Vec2 way) { return caster.cast({{-2.175, 3.075}, way, 20.0, 0.2}).range; };
    CHECK(range({1.0, 0.0}) == Approx(2.1).margin(0.08));
    CHECK(range({-1.0, 0.0}) == Approx(2.1).margin(0.08));
    CHECK(range({0.0, -1.0}) == Approx(2.925));
  }
  CHECK(worlds == 20);
}
