// SPDX-License-Identifier: LGPL-3.0-or-later
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/system.hpp"
#include "orca/image/grey_image.hpp"
#include "orca/maps/map_file.hpp"
#include "orca/sim/bitmap.hpp"
#include "orca/sim/occupancy.hpp"
#include "orca/sim/world_file.hpp"

namespace {

using orca::ObjectPtr;
using orca::idl::OccupancyGrid;

/// A server of the map that a file has: one of ROS's map_server, a floor plan as a picture, or a world of the simulator, drawn as it is
/// without people. See README.md.
class MapServer final : public orca::Component {
 public:
  explicit MapServer(orca::ComponentHost& host) : Component(host) { lap_every(std::chrono::seconds(1)); }

 private:
  static constexpr double kWorldCell = 0.05;   // [m] unless the graph says it
  static constexpr double kWorldHeight = 1.0;  // [m] what stands between the floor and this is on the map

  orca::Status configure() override {
    if (file_->empty()) return file_.refuse("it is not set; name a map, such as \"office.yaml\"");
    orca::Result<OccupancyGrid> map = is_world() ? draw_world() : read_file();
    if (!map) return file_.refuse(map.error().text());
    auto made = orca::make_object<OccupancyGrid>();
    *made = std::move(*map);
    map_ = std::move(made).seal();
    return orca::ok();
  }

  // A new subscriber gets the map, and with it all.
  orca::Outcome work() override {
    if (maps_.take_new_subscribers()) maps_.push(orca::copy_value(map_));
    return orca::again();
  }

  [[nodiscard]] bool is_world() const {
    const std::string file = file_->substr(0, file_->rfind('#'));
    return file.ends_with(".xml") || file.ends_with(".csv") || file.ends_with(".csv.gz");
  }

  [[nodiscard]] orca::Result<OccupancyGrid> read_file() const {
    orca::Result<OccupancyGrid> map = orca::maps::read_map(*file_, *resolution_);
    if (!map) return map;
    if (const auto doubt = orca::maps::doubt_about(*map)) log_warning(*file_ + ": " + *doubt);
    if (*resolution_ == 0.0) return map;  // a YAML file says which greys are occupied, free and not known
    const orca::Result<orca::image::GreyImage> plan = orca::image::read_image(*file_);
    if (!plan) return map;
    if (const auto doubt = orca::sim::doubt_about(*plan)) log_warning(*file_ + ": " + *doubt);
    return map;
  }

  [[nodiscard]] orca::Result<OccupancyGrid> draw_world() const {
    std::vector<std::string> warnings;
    const orca::Result<orca::sim::WorldModel> world = orca::sim::read_world(*file_, warnings);
    for (const std::string& warning : warnings) log_warning(warning);
    if (!world) return world.error();
    const double cell = *resolution_ > 0.0 ? *resolution_ : kWorldCell;
    const orca::Result<orca::sim::Occupancy> drawn = orca::sim::occupancy_of(*world, cell, kWorldHeight);
    if (!drawn) return drawn.error();
    OccupancyGrid map;
    map.name(world->name);
    orca::sim::fill(map, *drawn);
    return map;
  }

  orca::Result<orca::Loan<OccupancyGrid>> on_ask(const ObjectPtr<orca::idl::Ask>& /*ask*/) {
    return orca::copy_value(map_);
  }

  ObjectPtr<OccupancyGrid> map_;
  orca::QueryServer<orca::idl::Ask, OccupancyGrid> question_{
      *this, "OccupancyGridQuery", &MapServer::on_ask, {.text = "The whole map: about is not read."}};
  orca::PushServer<OccupancyGrid> maps_{
      *this, "OccupancyGridPush", {.text = "The whole map, to a new subscriber, and with it to all."}};
  orca::Param<std::string> file_{
      *this,
      "map",
      "",
      {.file = true,
       .fixed = true,
       .text = "Map: a .yaml file of ROS, a picture (.png, .pgm), or a world (.xml, .csv, .csv.gz)."}};
  orca::Param<double> resolution_{
      *this,
      "resolution",
      0.0,
      {.unit = "m",
       .min = 0.0,
       .fixed = true,
       .text = "Side of a pixel of a picture that has no .yaml file, or of a cell of a world, 0: 0.05 m."}};
};

}  // namespace

ORCA_COMPONENT(MapServer, "orca.MapServer")
