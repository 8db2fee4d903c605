// SPDX-License-Identifier: GPL-3.0-or-later
// What a MapServer serves of the files that people have.
#include <catch2/catch.hpp>

#include "orca/idl/navigation.hpp"
#include "orca/idl/system.hpp"
#include "orca/testing/component_trial.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::testing;
using Catch::Contains;
using orca::test::TempFolder;

namespace {

struct MapClient final : Partner {
  using Partner::Partner;
  QueryProxy<idl::Ask, idl::OccupancyGrid> asked{*this, "OccupancyGridQuery"};
  PushProxy<idl::OccupancyGrid> pushed{*this, "OccupancyGridPush", {.manual = true}};
};

using MapPtr = ObjectPtr<idl::OccupancyGrid>;

MapPtr map_of(const std::map<std::string, std::string>& params) {
  MapPtr map;
  try_component<MapClient>({.type = "orca.MapServer", .params = params},
                           [&](MapClient& client) { map = client.asked.query(client.asked.loan()).value(); });
  return map;
}

std::string refusal_of(const std::map<std::string, std::string>& params) {
  try {
    (void)map_of(params);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

// Returns the cell in which a point of the world lies.
int cell_of(const idl::OccupancyGrid& map, double x, double y) {
  const auto column = static_cast<std::size_t>((x - map.corner().x()) / map.resolution());
  const auto row = static_cast<std::size_t>((y - map.corner().y()) / map.resolution());
  return map.cells().at(row * map.columns() + column);
}

const std::string kGallery = ORCA_SOURCE_DIR "/sim/worlds/gallery.xml";

}  // namespace

TEST_CASE("a MapServer serves a map of ROS in the map frame", "[testing][map_server]") {
  const TempFolder folder;
  folder.write("hall.pgm", "P2 2 1 255 0 254\n");
  const std::string file = folder.write("hall.yaml",
                                        "image: hall.pgm\nresolution: 0.5\norigin: [3, 4, 0]\nnegate: "
                                        "0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  const MapPtr map = map_of({{"map", file}});
  CHECK(map->name() == "hall");
  CHECK(cell_of(*map, 3.2, 4.1) == 100);
  CHECK(cell_of(*map, 3.7, 4.1) == 0);
}

TEST_CASE("a MapServer serves a floor plan with a resolution", "[testing][map_server]") {
  const TempFolder folder;
  const MapPtr map =
      map_of({{"map", folder.write("plan.pgm", "P2 2 2 255 255 0 255 255\n")}, {"resolution", "10 cm"}});
  CHECK(map->resolution() == Approx(0.1));
  CHECK(cell_of(*map, 0.15, 0.15) == 100);
  CHECK(cell_of(*map, 0.15, 0.05) == 0);
}

TEST_CASE("a MapServer draws a world of the simulator, without people", "[testing][map_server]") {
  const MapPtr map = map_of({{"map", kGallery}});
  CHECK(map->name() == "gallery");
  CHECK(map->resolution() == 0.05);
  CHECK(cell_of(*map, 4.0, 3.0) == 100);  // A column.
  CHECK(cell_of(*map, 1.0, 1.0) == 0);    // The start.
  CHECK(cell_of(*map, 2.0, 2.0) == 0);    // A visitor.
  CHECK(map_of({{"map", kGallery}, {"resolution", "0.1 m"}})->resolution() == 0.1);
}

TEST_CASE("a MapServer pushes the map once to whoever begins to take it", "[testing][map_server]") {
  MapPtr first, none, again;
  try_component<MapClient>({.type = "orca.MapServer", .params = {{"map", kGallery}}}, [&](MapClient& client) {
    client.pushed.subscribe();
    first = client.pushed.get_update_wait_max(std::chrono::seconds(2));
    none = client.pushed.get_update_wait_max(std::chrono::seconds(20));
    client.pushed.unsubscribe();
    client.sleep(std::chrono::seconds(5));
    client.pushed.subscribe();
    again = client.pushed.get_update_wait_max(std::chrono::seconds(2));
  });
  REQUIRE(first);
  CHECK(first->name() == "gallery");
  CHECK_FALSE(none);
  REQUIRE(again);
  CHECK(again->cells() == first->cells());
}

TEST_CASE("a MapServer pushes the map to a client that comes as another leaves", "[testing][map_server]") {
  MapPtr first, again;
  try_component<MapClient>({.type = "orca.MapServer", .params = {{"map", kGallery}}}, [&](MapClient& client) {
    client.pushed.subscribe();
    first = client.pushed.get_update_wait_max(std::chrono::seconds(2));
    client.pushed.unsubscribe();
    client.pushed.subscribe();  // within one lap: there is one subscriber, as before
    again = client.pushed.get_update_wait_max(std::chrono::seconds(2));
  });
  REQUIRE(first);
  CHECK(again);
}

TEST_CASE("a MapServer refuses what is no map, at its parameter, with what to do", "[testing][map_server]") {
  const TempFolder folder;
  CHECK_THAT(refusal_of({}), Contains("\"map\"") && Contains("name a map, such as \"office.yaml\""));
  CHECK_THAT(refusal_of({{"map", folder.file("none.yaml")}}), Contains("none.yaml: cannot read the map"));
  CHECK_THAT(refusal_of({{"map", folder.write("plan.pgm", "P2 1 1 255 0\n")}}),
             Contains("give the resolution, the side of a pixel in metres"));
  CHECK_THAT(refusal_of({{"map", folder.write("world.xml", "<wrold/>")}}), Contains("world.xml:1"));
}

TEST_CASE("a MapServer refuses a world with all its errors, behind whatever warnings",
          "[testing][map_server]") {
  const TempFolder folder;
  folder.write("plan.pgm", "P2 6 1 255 0 255 200 200 200 200\n");  // light grey, a warning
  const std::string bitmap = "<bitmap name=\"plan\" file=\"plan.pgm\" resolution=\"0.1\"/>";
  const std::string file =
      folder.write("world.xml", "<world>\n" + bitmap + "\n<wal/>\n<obstacl/>\n</world>\n");
  const std::string refusal = refusal_of({{"map", file}});
  CHECK_THAT(refusal, Contains("world.xml:3") && Contains("world.xml:4") && !Contains("warning"));
}
