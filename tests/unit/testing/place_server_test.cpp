// SPDX-License-Identifier: GPL-3.0-or-later
// What a PlaceServer answers about a shipped world.
#include <catch2/catch.hpp>

#include <numbers>

#include "orca/idl/navigation.hpp"
#include "orca/idl/system.hpp"
#include "orca/testing/component_trial.hpp"

using namespace orca;
using namespace orca::testing;

namespace {

struct Visitor final : Partner {
  using Partner::Partner;
  QueryProxy<idl::Ask, idl::GoalPoint> place{*this, "PlaceQuery"};
  QueryProxy<idl::Ask, idl::OccupancyGrid> map{*this, "MapQuery"};
};

Trial gallery(const std::string& resolution) {
  return {.type = "orca.PlaceServer",
          .params = {{"world", ORCA_SOURCE_DIR "/sim/worlds/gallery.xml"}, {"map_resolution", resolution}}};
}

// Returns the cell in which a point of the world lies.
int cell_at(const idl::OccupancyGrid& map, double x, double y) {
  const auto column = static_cast<std::size_t>((x - map.corner().x()) / map.resolution());
  const auto row = static_cast<std::size_t>((y - map.corner().y()) / map.resolution());
  return map.cells().at(row * map.columns() + column);
}

}  // namespace

TEST_CASE("a PlaceServer answers with the map of its world, always the same", "[testing][places]") {
  ObjectPtr<idl::OccupancyGrid> map;
  ObjectPtr<idl::OccupancyGrid> again;
  try_component<Visitor>(gallery("0.1 m"), [&](Visitor& test) {
    map = test.map.query(test.map.loan()).value();
    again = test.map.query(test.map.loan()).value();
  });
  CHECK(map->name() == "gallery");
  CHECK(map->columns() >= 140);
  CHECK(map->cells().size() == std::size_t{map->columns()} * map->rows());
  CHECK(cell_at(*map, 4.0, 3.0) == 100);  // A column.
  CHECK(cell_at(*map, 7.0, 0.0) == 100);  // The south wall.
  CHECK(cell_at(*map, 1.0, 1.0) == 0);    // The start.
  CHECK(cell_at(*map, 2.0, 2.0) == 0);    // A visitor, who is not part of the map.
  CHECK(again->cells() == map->cells());
}

TEST_CASE("a PlaceServer answers where a place is and how one stands there", "[testing][places]") {
  ObjectPtr<idl::GoalPoint> start;
  try_component<Visitor>(gallery("1 m"), [&](Visitor& test) {
    auto ask = test.place.loan();
    ask->about() = "start";
    start = test.place.query(std::move(ask)).value();
  });
  CHECK(start->coordinate().point().x() == 1.0);
  CHECK(start->orientation().orientation().yaw() == Approx(std::numbers::pi / 4));
}
