// SPDX-License-Identifier: LGPL-3.0-or-later
#include "world_reader.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "codes.hpp"
#include "files/formats/mesh_file.hpp"
#include "generator_reader.hpp"
#include "orca/base/text.hpp"
#include "orca/robot_file/values.hpp"
#include "orca/sim/bitmap.hpp"
#include "orca/sim/stand.hpp"
#include "walker_reader.hpp"
#include "world_rules.hpp"

namespace orca::sim::detail {

using namespace robot_file::values;

namespace {

constexpr double kWallThickness = 0.1;
constexpr double kWallHeight = 2.5;

std::optional<BitmapScale> scale_of(const xml::Attributes& bitmap) {
  const bool has_width = bitmap.has("width");
  if (has_width && bitmap.has("resolution"))
    return bitmap.refuse_at("resolution", world_codes::kTwoScales,
                            "<bitmap> has a width as well; give one of the two");
  if (!has_width && !bitmap.has("resolution"))
    return bitmap.refuse(world_codes::kMissing,
                         "<bitmap> needs the attribute \"width\", of the whole picture, or "
                         "\"resolution\", the side of a pixel");
  const auto value = bitmap.number(has_width ? "width" : "resolution");
  if (!value) return std::nullopt;
  return has_width ? BitmapScale{*value, {}} : BitmapScale{{}, *value};
}

std::optional<Opening> opening_of(const xml::Attributes& door) {
  const auto at = door.number("at");
  const auto width = door.number("width");
  if (!at || !width) return std::nullopt;
  return Opening{*at, *width};
}

// Each place is compared with each obstacle.
constexpr std::size_t kMaxObstacles = 100'000;
constexpr std::size_t kMaxPlaces = 1000;
constexpr std::size_t kMaxWalkers = 200;
constexpr std::size_t kMaxItems = 200;
constexpr std::size_t kMaxDoors = 200;
constexpr std::size_t kMaxEvents = 1000;
constexpr double kPoint = 1e-3;  // [m] As large as a place is.

Finish finish_of(const xml::Attributes& element) {
  const auto surface = element.has("surface") ? element.choice("surface") : std::nullopt;
  if (!surface) return Finish::plain;
  return static_cast<Finish>(std::ranges::find(kFinishes, *surface) - kFinishes.begin());
}

std::optional<double> height(const xml::Attributes& element) {
  return element.number_or("height", kWallHeight);
}

using Elements = std::vector<std::pair<const xml::Element*, const xml::ElementRule*>>;

bool within_limits(const xml::Attributes& world, const Elements& elements) {
  const auto count = [&](const xml::ElementRule& rule) {
    return static_cast<std::size_t>(std::ranges::count(elements, &rule, &Elements::value_type::second));
  };
  const auto too_many = [&](std::size_t found, const char* what, std::size_t limit) {
    if (found <= limit) return false;
    world.error(world_codes::kTooMany, "the world has " + std::to_string(found) + " " + what + ", at most " +
                                           std::to_string(limit) + " are read");
    return true;
  };
  const bool obstacles = too_many(elements.size() - count(kPlaceRule), "obstacles", kMaxObstacles);
  const bool places = too_many(count(kPlaceRule), "places", kMaxPlaces);
  const bool walkers = too_many(count(kWalkerRule), "walkers", kMaxWalkers);
  const bool items = too_many(count(kItemRule), "items", kMaxItems);
  const bool doors = too_many(count(kLeafRule), "doors", kMaxDoors);
  const bool events = too_many(count(kMoveRule) + count(kKidnapRule) + count(kOutageRule) +
                                   count(kDrainRule) + count(kOpenRule) + count(kShutRule),
                               "moves, kidnaps, outages, drains and doors that open or shut", kMaxEvents);
  return !obstacles && !places && !walkers && !items && !doors && !events;
}

}  // namespace

constexpr std::array<WorldReader::Reader, 11> WorldReader::kReaders{{{&kWallRule, &WorldReader::wall},
                                                                     {&kRoomRule, &WorldReader::room},
                                                                     {&kBoxRule, &WorldReader::box},
                                                                     {&kCylinderRule, &WorldReader::cylinder},
                                                                     {&kPolygonRule, &WorldReader::polygon},
                                                                     {&kBitmapRule, &WorldReader::bitmap},
                                                                     {&kMeshRule, &WorldReader::mesh},
                                                                     {&kPlaceRule, &WorldReader::place},
                                                                     {&kGenerateRule, &WorldReader::generate},
                                                                     {&kWalkerRule, &WorldReader::walker},
                                                                     {&kItemRule, &WorldReader::item}}};

namespace {

using FixtureRead = void (FixtureReader::*)(const xml::Attributes&, const std::string&);
using EventRead = void (EventReader::*)(const xml::Attributes&);

constexpr std::array<std::pair<const xml::ElementRule*, FixtureRead>, 4> kFixtures{
    {{&kSillRule, &FixtureReader::sill},
     {&kWetRule, &FixtureReader::wet},
     {&kChargerRule, &FixtureReader::charger},
     {&kLeafRule, &FixtureReader::leaf}}};
constexpr std::array<std::pair<const xml::ElementRule*, EventRead>, 6> kEvents{
    {{&kMoveRule, &EventReader::move},
     {&kKidnapRule, &EventReader::kidnap},
     {&kOutageRule, &EventReader::outage},
     {&kDrainRule, &EventReader::drain},
     {&kOpenRule, &EventReader::open},
     {&kShutRule, &EventReader::shut}}};

// Returns how the elements of a rule are read; null: another table has that.
template <class Table>
auto find_in(const Table& table, const xml::ElementRule* rule) {
  const auto found = std::ranges::find(table, rule, &Table::value_type::first);
  return found == table.end() ? nullptr : found->second;
}

}  // namespace

WorldModel WorldReader::read(const xml::Element& root) {
  const Attributes world = attributes_of(root, kWorldRule);
  header(world);
  if (world.has("base")) read_base(world);
  read_elements(world);
  check_seed();
  check_places();
  check_walkers();
  check_items();
  fixtures_.place_chargers();
  world_.events = events_.take(world_.doors);
  return std::move(world_);
}

void WorldReader::read_elements(const Attributes& world) {
  const auto elements = world.children();
  if (!within_limits(world, elements)) return;
  for (const auto& [element, rule] : elements) {
    // Each rule of an element inside <world> has its reader.
    const Attributes attributes = attributes_of(*element, *rule);
    if (const auto read = find_in(kFixtures, rule)) {
      (fixtures_.*read)(attributes, own_name(attributes));
    } else if (const auto read_event = find_in(kEvents, rule)) {
      (events_.*read_event)(attributes);
    } else {
      (this->*std::ranges::find(kReaders, rule, &Reader::rule)->read)(attributes);
    }
  }
}

// Reads the elements of another world as if they stood here. Files that they name lie beside it.
void WorldReader::read_base(const Attributes& world) {
  const std::string own_file = file_name_;
  file_name_ = (std::filesystem::path(own_file).parent_path() / world.text("base").value_or("")).string();
  if (const auto document = xml::read_file(file_name_, reporter_.diagnostics())) {
    const Attributes base = attributes_of(document->root, kWorldRule);
    if (document->root.name() != kWorldRule.name || base.has("base")) {
      world.error_at(
          "base", world_codes::kBadBase,
          in_quotes(file_name_) + " is no world, or one with a base of its own; name one that has none");
    } else {
      read_elements(base);
    }
  }
  file_name_ = own_file;
}

WorldReader::Attributes WorldReader::attributes_of(const xml::Element& element,
                                                   const xml::ElementRule& rule) {
  return {element, rule, kWorldFile, reporter_};
}

void WorldReader::header(const Attributes& world) {
  world_.name = world.name("name").value_or("");
  const auto version = world.text("version");
  if (version && *version != "1")
    world.error_at(
        "version", world_codes::kVersion,
        "version " + in_quotes(*version) + " of the world format is not known; this Orca reads \"1\"");
}

void WorldReader::claim(const Attributes& element, const std::string& kind, const std::string& name) {
  const auto [first, is_new] = taken_.emplace(kind + " " + name, element.element().position());
  if (!is_new)
    element.error_at("name", world_codes::kDuplicateName,
                     "the " + kind + " \"" + name + "\" exists already, at " + first->second.text() +
                         "; choose another name");
}

std::string WorldReader::own_name(const Attributes& element) {
  if (!element.has("name")) return element.element().name();
  const auto name = element.name("name");
  if (name) claim(element, "obstacle", *name);
  return name.value_or("");
}

void WorldReader::add(const Attributes& element, Shape shape, double obstacle_height) {
  const auto bottom = element.number_or("bottom", 0.0);
  if (bottom && *bottom >= obstacle_height)
    return element.error_at("bottom", world_codes::kBottomAboveTop,
                            "the bottom must lie below the height, which is that of the top");
  if (bottom)
    world_.obstacles.push_back(
        {own_name(element), std::move(shape), obstacle_height, *bottom, nullptr, finish_of(element)});
}

void WorldReader::add_visitor(const Attributes& element, Shape shape, const Pose2& X_WO,
                              double obstacle_height) {
  if (element.has("name")) (void)own_name(element);
  if (finish_of(element) != Finish::plain)
    element.error_at("surface", world_codes::kBadValue, "what comes and goes is plain; leave this out");
  events_.visitor(element, std::move(shape), X_WO, obstacle_height);
}

void WorldReader::add_wall(const Attributes& element, WallPlan plan) {
  auto pieces = pieces_of(std::move(plan));
  if (!pieces) return element.error(world_codes::kBadWall, pieces.error().message);
  for (Obstacle& piece : *pieces) piece.finish = finish_of(element);
  std::ranges::move(*pieces, std::back_inserter(world_.obstacles));
}

void WorldReader::wall(const Attributes& element) {
  const auto from = read_point(element, "from");
  const auto to = read_point(element, "to");
  const auto thickness = element.number_or("thickness", kWallThickness);
  const auto tall = height(element);
  WallPlan plan{own_name(element), {}, {}, 0.0, 0.0, {}};
  for (const auto& [child, rule] : element.children())
    if (const auto opening = opening_of(attributes_of(*child, *rule))) plan.openings.push_back(*opening);
  if (!from || !to || !thickness || !tall) return;
  plan.from = *from;
  plan.to = *to;
  plan.thickness = *thickness;
  plan.height = *tall;
  add_wall(element, std::move(plan));
}

// Reads a room. The places of doors count from the western or southern end of their side.
void WorldReader::room(const Attributes& element) {
  std::map<std::string, std::vector<Opening>> openings;
  for (const auto& [child, rule] : element.children()) {
    const Attributes door = attributes_of(*child, *rule);
    const auto side = door.choice("side");
    const auto opening = opening_of(door);
    if (side && opening) openings[*side].push_back(*opening);
  }
  const auto from = read_point(element, "from");
  const auto to = read_point(element, "to");
  const auto thickness = element.number_or("thickness", kWallThickness);
  const auto tall = height(element);
  const std::string name = own_name(element);
  if (!from || !to || !thickness || !tall) return;
  if (from->x >= to->x || from->y >= to->y)
    return element.error_at("to", world_codes::kBadWall,
                            "\"to\" must lie right of and above \"from\": they are the lower left and the "
                            "upper right corner");
  struct Side {
    const char* name;
    Segment line;
  };
  const std::array<Side, 4> sides{
      Side{"south", {*from, {to->x, from->y}}}, Side{"north", {{from->x, to->y}, *to}},
      Side{"west", {*from, {from->x, to->y}}}, Side{"east", {{to->x, from->y}, *to}}};
  for (const Side& side : sides)
    add_wall(element, {name, side.line.a, side.line.b, *thickness, *tall, openings[side.name]});
}

void WorldReader::box(const Attributes& element) {
  const auto x = element.number("x");
  const auto y = element.number("y");
  const auto yaw = element.number_or("yaw", 0.0);
  const auto length = element.number("length");
  const auto width = element.number("width");
  const auto tall = height(element);
  if (!x || !y || !yaw || !length || !width || !tall) return;
  const Vec2 half{0.5 * *length, 0.5 * *width};
  if (EventReader::is_visitor(element)) return add_visitor(element, Box{{}, half}, {*x, *y, *yaw}, *tall);
  add(element, Box{{*x, *y, *yaw}, half}, *tall);
}

void WorldReader::cylinder(const Attributes& element) {
  const auto x = element.number("x");
  const auto y = element.number("y");
  const auto radius = element.number("radius");
  const auto tall = height(element);
  if (!x || !y || !radius || !tall) return;
  if (EventReader::is_visitor(element))
    return add_visitor(element, Circle{{}, *radius}, {*x, *y, 0.0}, *tall);
  add(element, Circle{{*x, *y}, *radius}, *tall);
}

void WorldReader::polygon(const Attributes& element) {
  const auto corners = read_points(element, "points");
  const auto tall = height(element);
  if (!corners) return;
  if (const std::string fault = polygon_fault(*corners); !fault.empty())
    return element.error_at("points", world_codes::kBadPolygon, fault);
  if (tall) add(element, outline_of(*corners), *tall);
}

void WorldReader::bitmap(const Attributes& element) {
  const auto file = element.text("file");
  const auto scale = scale_of(element);
  const auto tall = height(element);
  if (!file) return;
  const auto path = std::filesystem::path(file_name_).parent_path() / *file;
  // Without its scale the picture is read all the same, for its own errors.
  std::optional<std::string> doubt;
  auto map =
      read_bitmap_world(path.lexically_normal().string(), scale.value_or(BitmapScale{{}, 1e-3}), 2.5, &doubt);
  if (doubt)
    reporter_.diagnostics().warning(world_codes::kLightGrey, element.element().position(),
                                    *file + ": " + *doubt);
  if (!map) return element.error_at("file", world_codes::kUnreadable, map.error().text());
  if (scale && tall) add(element, std::move(map->obstacles.front().shape), *tall);
}

void WorldReader::mesh(const Attributes& element) {
  const auto file = element.text("file");
  const auto x = element.number("x");
  const auto y = element.number("y");
  const auto z = element.number_or("z", 0.0);
  const auto yaw = element.number_or("yaw", 0.0);
  const auto scale = element.number_or("scale", 1.0);
  if (!file) return;
  const auto path = std::filesystem::path(file_name_).parent_path() / *file;
  auto read = read_mesh(path.lexically_normal().string());
  if (!read) return element.error_at("file", world_codes::kUnreadableMesh, read.error().text());
  faces_ += read->triangles.size();
  if (faces_ > kMaxFaces)
    return element.error_at("file", world_codes::kTooMany,
                            "with this mesh the world has more than 1000000 faces, the most that is read; "
                            "simplify its meshes");
  if (!x || !y || !z || !yaw || !scale) return;
  Mesh mesh = placed(std::move(*read), {*scale, *scale, *scale}, {*x, *y, *yaw}, *z);
  if (const Status sound = check_mesh(mesh, path.lexically_normal().string()); !sound)
    return element.error_at("scale", world_codes::kUnreadableMesh, sound.error().text());
  world_.obstacles.push_back(mesh_obstacle(own_name(element), std::move(mesh)));
}

void WorldReader::place(const Attributes& element) {
  const auto name = element.name("name");
  const auto x = element.number("x");
  const auto y = element.number("y");
  const auto yaw = element.number_or("yaw", 0.0);
  if (name) claim(element, "place", *name);
  if (name && x && y && yaw) add_place(element, {*name, {*x, *y, wrapped(*yaw)}});
}

void WorldReader::add_place(const Attributes& element, Place place) {
  world_.places.push_back(std::move(place));
  place_positions_.push_back(element.element().position());
}

void WorldReader::generate(const Attributes& element) {
  if (generated_)
    return element.error(world_codes::kTooMany, "there is a <generate> already, at " + generated_->text() +
                                                    "; a world has one, leave this out");
  generated_ = element.element().position();
  const auto order = read_generate(element, reporter_);
  if (!order) return;
  auto made = sim::generate(order->family, seed_.value_or(order->seed), order->radius);
  if (!made) return element.error(world_codes::kCannotGenerate, made.error().message);
  std::ranges::move(made->obstacles, std::back_inserter(world_.obstacles));
  for (Place& place : made->places) {
    claim(element, "place", place.name);
    add_place(element, std::move(place));
  }
}

void WorldReader::walker(const Attributes& element) {
  auto walker = read_walker(element);
  if (element.has("name") && !walker.name.empty()) claim(element, "obstacle", walker.name);
  world_.walkers.push_back(std::move(walker));
  walker_positions_.push_back(element.element().position());
}

void WorldReader::item(const Attributes& element) {
  const auto name = element.name("name");
  const auto x = element.number("x");
  const auto y = element.number("y");
  const auto radius = element.number("radius");
  const auto tall = element.number("height");
  if (name) claim(element, "obstacle", *name);
  if (!name || !x || !y || !radius || !tall) return;
  world_.items.push_back({*name, *radius, *tall, {*x, *y, 0.0}});
  item_positions_.push_back(element.element().position());
}

void WorldReader::check_walkers() {
  for (std::size_t i = 0; i < world_.walkers.size(); ++i)
    if (const Obstacle* o = obstacle_on_track(world_.walkers[i], world_))
      reporter_.error(world_codes::kBadWalker, walker_positions_[i],
                      "\"" + world_.walkers[i].name + "\" would walk through obstacle \"" + o->name +
                          "\"; lead its track around");
}

void WorldReader::check_items() {
  for (std::size_t i = 0; i < world_.items.size(); ++i)
    for (const StandsIn& there : what_holds(world_.items[i], world_))
      reporter_.error(world_codes::kBadItem, item_positions_[i],
                      "item " + in_quotes(world_.items[i].name) + " stands in " + in_quotes(there.name) +
                          ", " + how_to_clear(there) + "; put it on free floor");
}

void WorldReader::check_seed() {
  if (seed_ && !generated_)
    reporter_.error(world_codes::kNumber, {file_name_, 0, 0},
                    "\"#" + std::to_string(*seed_) +
                        "\" is the seed of what is generated, but nothing in this world is; leave it out");
}

void WorldReader::check_places() {
  for (const Obstacle& o : world_.obstacles) {
    if (o.bottom > 0.0) continue;  // A robot may fit under it.
    const Bounds b = bounds_of(o.shape);
    for (std::size_t i = 0; i < world_.places.size(); ++i) {
      const Place& place = world_.places[i];
      const Vec2 p = place.pose.position();
      if (p.x < b.low.x || p.x > b.high.x || p.y < b.low.y || p.y > b.high.y) continue;
      if (!overlap(o, Circle{p, kPoint}, 0.0, kPoint)) continue;
      reporter_.error(
          world_codes::kPlaceInObstacle, place_positions_[i],
          "place \"" + place.name + "\" lies inside obstacle \"" + o.name + "\"; no robot can get there");
    }
  }
}

}  // namespace orca::sim::detail
