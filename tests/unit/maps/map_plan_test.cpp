// SPDX-License-Identifier: GPL-3.0-or-later
// Floor plans: pictures without a YAML file.
#include <algorithm>

#include "map_files.hpp"
#include "public_data.hpp"

using namespace orca;
using namespace orca::maps;
using namespace orca::maps::test;
using Catch::Contains;
using orca::test::TempFolder;

TEST_CASE("a picture alone is a map whose lower left corner is the origin", "[maps][plan]") {
  const TempFolder folder;
  const auto map =
      read_map(folder.write("floor.pgm", pgm(5, 2, {0, 127, 128, 255, 255, 0, 255, 255, 255, 255})), 0.1);
  REQUIRE(map);
  CHECK(map->name() == "floor");
  CHECK(map->resolution() == 0.1);
  CHECK(map->corner().x() == 0.0);
  CHECK(map->corner().orientation() == 0.0);
  CHECK(cells_of(*map) == std::vector<int>{100, 0, 0, 0, 0, 100, 100, 0, 0, 0});
}

TEST_CASE("a picture alone needs a resolution, a YAML file has its own", "[maps][plan][refused]") {
  const TempFolder folder;
  const std::string plan = folder.write("map.pgm", pgm(1, 1, {0}));
  CHECK_THAT(fault_of(read_map(plan)), Contains("give the resolution, the side of a pixel in metres"));
  CHECK_THAT(fault_of(read_map(plan, 50.0)), Contains("the resolution is 50; it is the side of a pixel"));
  CHECK_THAT(fault_of(read_map(folder.write("office.yaml", kHeader), 0.1)),
             Contains("the file has a resolution of its own; leave the other one out"));
}

TEST_CASE("a picture in a format that is not read is refused with how to convert it",
          "[maps][plan][refused]") {
  const TempFolder folder;
  CHECK_THAT(fault_of(read_map(folder.write("floor.jpg", "\xFF\xD8\xFF\xE0..."), 0.1)),
             Contains("this is a JPEG file") && Contains("convert floor.jpg floor.png"));
}

TEST_CASE("a map with nothing occupied, nothing free or more occupied than free is doubtful",
          "[maps][plan]") {
  const auto doubt = [](const std::vector<int>& cells) {
    idl::OccupancyGrid map;
    for (const int cell : cells) map.cells().push_back(static_cast<std::uint8_t>(cell));
    return doubt_about(map).value_or("");
  };
  CHECK(doubt({100, 0, 0, 255, 255}).empty());
  CHECK(doubt({100, 0}).empty());
  CHECK_THAT(doubt({0, 49, 255}), Contains("no cell is occupied"));
  CHECK_THAT(doubt({50, 100, 255}), Contains("no cell is free"));
  CHECK_THAT(doubt({100, 100, 0, 255}), Contains("more cells are occupied (2) than free (1)"));
}

TEST_CASE("the floor plans of Stage are maps", "[maps][plan][data]") {
  const std::string folder = orca::test::public_data("stage_maps");
  if (folder.empty()) return;
  for (const std::string name : {"autolab", "cave", "cave_filled", "hospital", "hospital_section"}) {
    CAPTURE(name);
    const auto map = read_map(folder + "/" + name + ".png", 0.1);
    INFO(fault_of(map));
    REQUIRE(map);
    const auto occupied = std::ranges::count(map->cells(), 100);
    CHECK(doubt_about(*map).value_or("").empty());
    CHECK(occupied > 0);
    CHECK(occupied + std::ranges::count(map->cells(), 0) == static_cast<std::ptrdiff_t>(map->cells().size()));
  }
}
