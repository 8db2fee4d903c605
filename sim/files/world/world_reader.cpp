// SPDX-License-Identifier: LGPL-3.0-or-later
#include "world_reader.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "files/formats/mesh_file.hpp"
#include "generator_reader.hpp"
#include "orca/sim/bitmap.hpp"
#include "walker_reader.hpp"

namespace orca::sim::detail {
namespace {

constexpr double kWallThickness = 0.1;
constexpr double kWallHeight = 2.5;
constexpr std::size_t kMaxCorners = 1000;

// Why these corners do not bound an area; empty if they do.
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

std::optional<BitmapScale> scale_of(const Attributes& bitmap) {
  const bool has_width = bitmap.has("width");
  if (has_width && bitmap.has("resolution"))
    return bitmap.error_at("resolution", 15, "<bitmap> has a width as well; give one of the two"),
           std::nullopt;
  if (!has_width && !bitmap.has("resolution"))
    return bitmap.error(
               4,
               "<bitmap> needs the attribute \"width\", of the whole picture, or \"resolution\", the "
               "side of a pixel"),
           std::nullopt;
  const auto value = bitmap.quantity(has_width ? "width" : "resolution", "m", Sign::positive);
  if (!value) return std::nullopt;
  return has_width ? BitmapScale{*value, {}} : BitmapScale{{}, *value};
}

// Each place is compared with each obstacle.
constexpr std::size_t kMaxObstacles = 100'000;
constexpr std::size_t kMaxPlaces = 1000;
constexpr std::size_t kMaxWalkers = 200;
constexpr double kPoint = 1e-3;  // [m] As large as a place is.

const std::vector<std::string> kElements{"wall",   "room", "box",   "cylinder", "polygon",
                                         "bitmap", "mesh", "place", "generate", "walker"};

}  // namespace

WorldModel WorldReader::read(const xml::Element& root) {
  const Attributes world = of(root);
  header(world);
  if (!within_limits(world)) return std::move(world_);
  constexpr std::array<Read, 10> kReaders{
      &WorldReader::wall,     &WorldReader::room,   &WorldReader::box,  &WorldReader::cylinder,
      &WorldReader::polygon,  &WorldReader::bitmap, &WorldReader::mesh, &WorldReader::place,
      &WorldReader::generate, &WorldReader::walker};
  for (const xml::Element& e : root.children()) {
    const auto known = std::ranges::find(kElements, e.name());
    if (known == kElements.end()) continue;
    (this->*kReaders[static_cast<std::size_t>(known - kElements.begin())])(of(e));
  }
  check_seed(world);
  check_places();
  check_walkers();
  return std::move(world_);
}

void WorldReader::header(const Attributes& world) {
  world.allow({"name", "version", "text"}, kElements);
  world_.name = world.name("name").value_or("");
  const auto version = world.text("version");
  if (version && *version != "1")
    world.error_at("version", 10,
                   "version \"" + *version + "\" of the world format is not known; this Orca reads \"1\"");
}

bool WorldReader::within_limits(const Attributes& world) const {
  const auto& elements = world.element().children();
  const auto count = [&](std::string_view name) {
    return static_cast<std::size_t>(std::ranges::count(elements, name, &xml::Element::name));
  };
  const auto too_many = [&](std::size_t found, const char* what, std::size_t limit) {
    if (found <= limit) return false;
    world.error(14, "the world has " + std::to_string(found) + " " + what + ", at most " +
                        std::to_string(limit) + " are read");
    return true;
  };
  const bool obstacles = too_many(elements.size() - count("place"), "obstacles", kMaxObstacles);
  const bool places = too_many(count("place"), "places", kMaxPlaces);
  const bool walkers = too_many(count("walker"), "walkers", kMaxWalkers);
  return !obstacles && !places && !walkers;
}

std::optional<double> WorldReader::height(const Attributes& element) const {
  return element.quantity_or("height", "m", Sign::positive, kWallHeight);
}

void WorldReader::claim(const Attributes& element, const std::string& kind, const std::string& name) {
  const auto [first, is_new] = taken_.emplace(kind + " " + name, element.element().position());
  if (!is_new)
    element.error_at("name", 7,
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
  const auto bottom = element.quantity_or("bottom", "m", Sign::not_negative, 0.0);
  if (bottom && *bottom >= obstacle_height)
    return element.error_at("bottom", 22, "the bottom must lie below the height, which is that of the top");
  if (bottom) world_.obstacles.push_back({own_name(element), std::move(shape), obstacle_height, *bottom});
}

void WorldReader::add_wall(const Attributes& element, WallPlan plan) {
  auto pieces = pieces_of(std::move(plan));
  if (!pieces) return element.error(8, pieces.error().message);
  std::ranges::move(*pieces, std::back_inserter(world_.obstacles));
}

std::optional<Opening> WorldReader::door(const Attributes& element, bool in_room) const {
  if (in_room) {
    element.allow({"side", "at", "width"}, {});
  } else {
    element.allow({"at", "width"}, {});
  }
  const auto at = element.quantity("at", "m", Sign::positive);
  const auto width = element.quantity("width", "m", Sign::positive);
  if (!at || !width) return std::nullopt;
  return Opening{*at, *width};
}

void WorldReader::wall(const Attributes& element) {
  element.allow({"name", "from", "to", "thickness", "height"}, {"door"});
  const auto from = element.point("from");
  const auto to = element.point("to");
  const auto thickness = element.quantity_or("thickness", "m", Sign::positive, kWallThickness);
  const auto tall = height(element);
  WallPlan plan{own_name(element), {}, {}, 0.0, 0.0, {}};
  for (const xml::Element& e : element.element().children())
    if (const auto opening = e.name() == "door" ? door(of(e), false) : std::nullopt)
      plan.openings.push_back(*opening);
  if (!from || !to || !thickness || !tall) return;
  plan.from = *from;
  plan.to = *to;
  plan.thickness = *thickness;
  plan.height = *tall;
  add_wall(element, std::move(plan));
}

// Doors of a side count from its western or southern end.
void WorldReader::room(const Attributes& element) {
  element.allow({"name", "from", "to", "thickness", "height"}, {"door"});
  const std::vector<std::string> sides{"south", "north", "west", "east"};
  std::map<std::string, std::vector<Opening>> openings;
  for (const xml::Element& e : element.element().children()) {
    if (e.name() != "door") continue;
    const auto side = of(e).choice("side", sides);
    const auto opening = door(of(e), true);
    if (side && opening) openings[*side].push_back(*opening);
  }
  const auto from = element.point("from");
  const auto to = element.point("to");
  const auto thickness = element.quantity_or("thickness", "m", Sign::positive, kWallThickness);
  const auto tall = height(element);
  const std::string name = own_name(element);
  if (!from || !to || !thickness || !tall) return;
  if (from->x >= to->x || from->y >= to->y)
    return element.error_at("to", 8,
                            "\"to\" must lie right of and above \"from\": they are the lower left and the "
                            "upper right corner");
  const std::array<Segment, 4> lines{Segment{*from, {to->x, from->y}}, Segment{{from->x, to->y}, *to},
                                     Segment{*from, {from->x, to->y}}, Segment{{to->x, from->y}, *to}};
  for (std::size_t i = 0; i < lines.size(); ++i)
    add_wall(element, {name, lines[i].a, lines[i].b, *thickness, *tall, openings[sides[i]]});
}

void WorldReader::box(const Attributes& element) {
  element.allow({"name", "x", "y", "yaw", "length", "width", "height", "bottom"}, {});
  const auto x = element.quantity("x", "m", Sign::any);
  const auto y = element.quantity("y", "m", Sign::any);
  const auto yaw = element.quantity_or("yaw", "rad", Sign::any, 0.0);
  const auto length = element.quantity("length", "m", Sign::positive);
  const auto width = element.quantity("width", "m", Sign::positive);
  const auto tall = height(element);
  if (x && y && yaw && length && width && tall)
    add(element, Box{{*x, *y, *yaw}, {0.5 * *length, 0.5 * *width}}, *tall);
}

void WorldReader::cylinder(const Attributes& element) {
  element.allow({"name", "x", "y", "radius", "height", "bottom"}, {});
  const auto x = element.quantity("x", "m", Sign::any);
  const auto y = element.quantity("y", "m", Sign::any);
  const auto radius = element.quantity("radius", "m", Sign::positive);
  const auto tall = height(element);
  if (x && y && radius && tall) add(element, Circle{{*x, *y}, *radius}, *tall);
}

void WorldReader::polygon(const Attributes& element) {
  element.allow({"name", "points", "height", "bottom"}, {});
  const auto corners = element.points("points");
  const auto tall = height(element);
  if (!corners) return;
  if (const std::string fault = polygon_fault(*corners); !fault.empty())
    return element.error_at("points", 9, fault);
  if (tall) add(element, outline_of(*corners), *tall);
}

void WorldReader::bitmap(const Attributes& element) {
  element.allow({"name", "file", "width", "resolution", "height"}, {});
  const auto file = element.text("file");
  const auto scale = scale_of(element);
  const auto tall = height(element);
  if (!file || !scale || !tall) return;
  const auto path = std::filesystem::path(file_name_).parent_path() / *file;
  auto map = read_bitmap_world(path.lexically_normal().string(), *scale, *tall);
  if (!map) return element.error_at("file", 11, map.error().text());
  add(element, std::move(map->obstacles.front().shape), *tall);
}

void WorldReader::mesh(const Attributes& element) {
  element.allow({"name", "file", "x", "y", "z", "yaw", "scale"}, {});
  const auto file = element.text("file");
  const auto x = element.quantity("x", "m", Sign::any);
  const auto y = element.quantity("y", "m", Sign::any);
  const auto z = element.quantity_or("z", "m", Sign::any, 0.0);
  const auto yaw = element.quantity_or("yaw", "rad", Sign::any, 0.0);
  const auto scale = element.quantity_or("scale", "", Sign::positive, 1.0);
  if (!file || !x || !y || !z || !yaw || !scale) return;
  const auto path = std::filesystem::path(file_name_).parent_path() / *file;
  auto read = read_mesh(path.lexically_normal().string());
  if (!read) return element.error_at("file", 21, read.error().text());
  faces_ += read->triangles.size();
  if (faces_ > kMaxFaces)
    return element.error_at("file", 14,
                            "with this mesh the world has more than 1000000 faces, the most that is read; "
                            "simplify its meshes");
  Mesh mesh = placed(std::move(*read), {*scale, *scale, *scale}, {*x, *y, *yaw}, *z);
  if (const Status sound = check_mesh(mesh, path.lexically_normal().string()); !sound)
    return element.error_at("scale", 21, sound.error().text());
  world_.obstacles.push_back(mesh_obstacle(own_name(element), std::move(mesh)));
}

void WorldReader::place(const Attributes& element) {
  element.allow({"name", "x", "y", "yaw"}, {});
  const auto name = element.name("name");
  const auto x = element.quantity("x", "m", Sign::any);
  const auto y = element.quantity("y", "m", Sign::any);
  const auto yaw = element.quantity_or("yaw", "rad", Sign::any, 0.0);
  if (name) claim(element, "place", *name);
  if (name && x && y && yaw) add_place(element, {*name, {*x, *y, wrapped(*yaw)}});
}

void WorldReader::add_place(const Attributes& element, Place place) {
  world_.places.push_back(std::move(place));
  place_positions_.push_back(element.element().position());
}

void WorldReader::generate(const Attributes& element) {
  if (generated_)
    return element.error(
        14, "there is a <generate> already, at " + generated_->text() + "; a world has one, leave this out");
  generated_ = element.element().position();
  const auto order = read_generate(element);
  if (!order) return;
  auto made = sim::generate(order->family, seed_.value_or(order->seed), order->radius);
  if (!made) return element.error(18, made.error().message);
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

void WorldReader::check_walkers() const {
  for (std::size_t i = 0; i < world_.walkers.size(); ++i)
    if (const Obstacle* o = obstacle_on_track(world_.walkers[i], world_))
      diagnostics_.error("W019", walker_positions_[i],
                         "\"" + world_.walkers[i].name + "\" would walk through obstacle \"" + o->name +
                             "\"; lead its track around");
}

void WorldReader::check_seed(const Attributes& world) const {
  const auto is_generate = [](const xml::Element& e) { return e.name() == "generate"; };
  if (seed_ && std::ranges::none_of(world.element().children(), is_generate))
    diagnostics_.error("W017", {file_name_, 0, 0},
                       "\"#" + std::to_string(*seed_) +
                           "\" is the seed of what is generated, but nothing in this world is; leave it out");
}

void WorldReader::check_places() const {
  for (const Obstacle& o : world_.obstacles) {
    if (o.bottom > 0.0) continue;  // A robot may fit under it.
    const Bounds b = bounds_of(o.shape);
    for (std::size_t i = 0; i < world_.places.size(); ++i) {
      const Place& place = world_.places[i];
      const Vec2 p = place.pose.position();
      if (p.x < b.low.x || p.x > b.high.x || p.y < b.low.y || p.y > b.high.y) continue;
      if (!overlap(o, Circle{p, kPoint}, 0.0, kPoint)) continue;
      diagnostics_.error(
          "W012", place_positions_[i],
          "place \"" + place.name + "\" lies inside obstacle \"" + o.name + "\"; no robot can get there");
    }
  }
}

}  // namespace orca::sim::detail
