// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <string>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/system.hpp"
#include "orca/sim/occupancy.hpp"
#include "orca/sim/world_file.hpp"
#include "orca/xml/names.hpp"

namespace {

/// A server that knows where the named places of a world file are, drawn ones included, and has its map. Who asks for them knows names
/// only: a map of a real building can answer in its place.
class PlaceServer final : public orca::Component {
 public:
  explicit PlaceServer(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status configure() override {
    if (world_file_->empty())
      return world_file_.refuse("it is not set; name a world, e.g. \"../sim/worlds/office.xml\"");
    std::vector<std::string> warnings;
    orca::Result<orca::sim::WorldModel> world = orca::sim::read_world(*world_file_, warnings);
    for (const std::string& warning : warnings) log_warning(warning);
    if (!world) return world_file_.refuse(world.error().message);
    world_ = std::move(*world);
    map_ = {};
    return orca::ok();
  }

  // It only answers.
  orca::Outcome work() override { return orca::done(); }

  orca::Result<orca::Loan<orca::idl::GoalPoint>> on_ask(const orca::ObjectPtr<orca::idl::Ask>& ask) {
    const auto place = std::ranges::find(world_.places, ask->about(), &orca::sim::Place::name);
    if (place == world_.places.end()) return unknown(ask->about());
    auto answer = orca::make_object<orca::idl::GoalPoint>();
    answer->name() = place->name;
    answer->coordinate().point().x(place->pose.x);
    answer->coordinate().point().y(place->pose.y);
    answer->orientation().orientation().yaw(place->pose.yaw);
    return answer;
  }

  // The map is made when somebody asks for it first. All later answers are copies.
  orca::Result<orca::Loan<orca::idl::OccupancyGrid>> on_map(const orca::ObjectPtr<orca::idl::Ask>& /*ask*/) {
    if (!map_) {
      const orca::Result<orca::sim::Occupancy> cells =
          orca::sim::occupancy_of(world_, *map_resolution_, *map_height_);
      if (!cells) return cells.error();
      map_ = map_of(*cells).seal();
    }
    return orca::copy_value(map_);
  }

  [[nodiscard]] orca::Loan<orca::idl::OccupancyGrid> map_of(const orca::sim::Occupancy& cells) const {
    auto map = orca::make_object<orca::idl::OccupancyGrid>();
    map->name() = world_.name;
    orca::sim::fill(*map, cells);
    return map;
  }

  [[nodiscard]] orca::Error unknown(const std::string& name) const {
    std::vector<std::string> names;
    for (const orca::sim::Place& place : world_.places) names.push_back(place.name);
    return orca::fail(orca::Code::not_found,
                      orca::in_quotes(name) + " is no place of " + *world_file_ +
                          "; places: " + orca::listed(names) +
                          orca::xml::did_you_mean(orca::xml::nearest_name(name, names)));
  }

  orca::QueryServer<orca::idl::Ask, orca::idl::GoalPoint> question_{
      *this,
      "PlaceQuery",
      &PlaceServer::on_ask,
      {.text = "Where a place is: about is its name; the answer holds coordinate and orientation."}};
  orca::QueryServer<orca::idl::Ask, orca::idl::OccupancyGrid> map_question_{
      *this,
      "MapQuery",
      &PlaceServer::on_map,
      {.text = "The map of the world, without people: about is not read."}};
  orca::Param<std::string> world_file_{
      *this,
      "world",
      "",
      {.file = true,
       .fixed = true,
       .text = "World with the places: .xml, .csv or .csv.gz; FILE#7 is number 7 of those in the file."}};

  orca::Param<double> map_resolution_{
      *this,
      "map_resolution",
      0.1,
      {.unit = "m", .min = 0.01, .fixed = true, .text = "Side of a cell of the map."}};
  orca::Param<double> map_height_{*this,
                                  "map_height",
                                  1.0,
                                  {.unit = "m",
                                   .min = 0.01,
                                   .fixed = true,
                                   .text = "The map shows what stands between the floor and this height."}};

  orca::sim::WorldModel world_;
  orca::ObjectPtr<orca::idl::OccupancyGrid> map_;
};

}  // namespace

ORCA_COMPONENT(PlaceServer, "orca.PlaceServer")
