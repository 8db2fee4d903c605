// SPDX-License-Identifier: LGPL-3.0-or-later
#include "fixture_reader.hpp"

#include <numbers>
#include <utility>

#include "codes.hpp"
#include "orca/base/text.hpp"
#include "orca/robot_file/values.hpp"

namespace orca::sim::detail {

using namespace robot_file::values;

namespace {

constexpr std::size_t kMaxCorners = 1000;
constexpr double kNarrowest = 0.1;  // [m] of a door
constexpr double kThickness = 0.04;
constexpr double kDoorHeight = 2.0;
constexpr double kQuarter = 0.5 * std::numbers::pi;

}  // namespace

std::string polygon_fault(const std::vector<Vec2>& corners) {
  if (corners.size() < 3)
    return "a polygon needs at least 3 corners, found " + std::to_string(corners.size());
  if (corners.size() > kMaxCorners)
    return "a polygon may have 1000 corners, found " + std::to_string(corners.size()) + "; use a <bitmap>";
  if (corners.front() == corners.back())
    return "the last corner repeats the first; a polygon closes by itself, leave the last one out";
  const std::vector<Segment> edges = outline_of(corners).edges;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (edges[i].a == edges[i].b) return "two corners in a row are the same point";
    for (std::size_t k = i + 2; k < edges.size(); ++k)
      if (cross_each_other(edges[i], edges[k])) return "two sides of the polygon cross each other";
  }
  const Bounds b = bounds_of(Outline{edges});
  return b.low.x < b.high.x && b.low.y < b.high.y ? "" : "the polygon has no area";
}

void FixtureReader::sill(const xml::Attributes& element, const std::string& name) {
  const auto from = read_point(element, "from");
  const auto to = read_point(element, "to");
  const auto tall = element.number("height");
  if (from && to && tall) world_.floor.sills.push_back({name, {*from, *to}, *tall});
}

void FixtureReader::wet(const xml::Attributes& element, const std::string& name) {
  WetPatch patch;
  patch.name = name;
  set(patch.slip, element.number_or("slip", patch.slip));
  set(patch.grip, element.number_or("grip", patch.grip));
  const auto corners = read_points(element, "points");
  if (!corners) return;
  if (const std::string fault = polygon_fault(*corners); !fault.empty())
    return element.error_at("points", world_codes::kBadPolygon, fault);
  patch.area = outline_of(*corners);
  world_.floor.patches.push_back(std::move(patch));
}

void FixtureReader::leaf(const xml::Attributes& element, const std::string& name) {
  const auto from = read_point(element, "from");
  const auto to = read_point(element, "to");
  Door door{.name = name, .swing = kQuarter, .thickness = kThickness, .height = kDoorHeight};
  if (element.has("kind")) door.slides = element.choice("kind") == "slides";
  if (door.slides && element.has("swing"))
    element.error_at("swing", world_codes::kBadDoor, "a door that slides does not swing; leave this out");
  set(door.swing, element.number_or("swing", door.swing));
  if (element.has("starts")) door.open = element.choice("starts") == "open";
  set(door.thickness, element.number_or("thickness", door.thickness));
  set(door.height, element.number_or("height", door.height));
  if (element.has("closes_after")) door.closer = element.duration("closes_after");
  if (!from || !to) return;
  if (norm(*to - *from) < kNarrowest)
    return element.error(world_codes::kBadDoor,
                         "a door is at least 0.1 m wide; move \"to\" away from \"from\"");
  door.shut = {*from, *to};
  world_.doors.push_back(std::move(door));
}

void FixtureReader::charger(const xml::Attributes& element, const std::string& /*name*/) {
  const auto place = element.name("place");
  const auto reach = element.number("reach");
  if (!place || !reach) return;
  const bool at_front = element.has("touch") && element.choice("touch").has_value();
  world_.chargers.push_back({*place, {}, *reach, at_front});
  charger_positions_.push_back(element.element().position());
}

void FixtureReader::place_chargers() {
  std::vector<std::string> names;
  for (const Place& place : world_.places) names.push_back(place.name);
  for (std::size_t i = 0; i < world_.chargers.size(); ++i) {
    Charger& charger = world_.chargers[i];
    if (const Place* const place = world_.place(charger.place))
      charger.pose = place->pose;
    else
      reporter_.error(world_codes::kNoSuchPlace, charger_positions_[i],
                      "there is no place " + in_quotes(charger.place) + reporter_.hint(charger.place, names));
  }
}

}  // namespace orca::sim::detail
