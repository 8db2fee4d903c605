// SPDX-License-Identifier: LGPL-3.0-or-later
#include "walker_reader.hpp"

#include <algorithm>

#include "codes.hpp"
#include "orca/base/portable_math.hpp"
#include "orca/robot_file/values.hpp"

namespace orca::sim::detail {

using namespace robot_file::values;

namespace {

constexpr std::size_t kMaxTrackCorners = 100;
constexpr double kShortest = 0.001;  // [m]
constexpr double kSlowest = 0.01;    // [m/s]
constexpr double kFastest = 20.0;
constexpr double kWidestLegs = 2.0 * Walker::kHip;  // Diameter as a share of the radius.
constexpr Duration kLongest = std::chrono::hours{1000};

// Returns the reason why nobody can walk along these corners; empty if one can.
std::string track_fault(const std::vector<Vec2>& track) {
  if (track.size() < 2) return "a track needs at least 2 corners, found " + std::to_string(track.size());
  if (track.size() > kMaxTrackCorners)
    return "a track may have 100 corners, found " + std::to_string(track.size());
  const auto elsewhere = [&](Vec2 corner) { return norm(corner - track.front()) >= kShortest; };
  return std::ranges::any_of(track, elsewhere) ? ""
                                               : "the track has no length: all its corners are one point";
}

void read_track(const xml::Attributes& element, Walker& walker) {
  auto track = read_points(element, "track");
  if (!track) return;
  if (const std::string fault = track_fault(*track); !fault.empty())
    return element.error_at("track", world_codes::kBadWalker, fault);
  walker.track = std::move(*track);
}

void check_limits(const xml::Attributes& element, const Walker& walker) {
  if (walker.speed < kSlowest || walker.speed > kFastest)
    element.error_at("speed", world_codes::kBadWalker, "a walker's speed is between 0.01 m/s and 20 m/s");
  if (walker.pause > kLongest)
    element.error_at("pause", world_codes::kBadWalker, "a rest of more than 1000 h is not simulated");
  if (walker.start > kLongest)
    element.error_at("start", world_codes::kBadWalker, "a walker's start is at most 1000 h");
}

// Returns the area that a circle covers along a leg, without the half circles at the ends.
Box swept(Vec2 from, Vec2 to, double radius) {
  const Vec2 middle = 0.5 * (from + to);
  const Vec2 way = to - from;
  return {{middle.x, middle.y, portable::atan2(way.y, way.x)}, {0.5 * norm(way), radius}};
}

void read_colour(const xml::Attributes& element, Walker& walker) {
  if (!element.has("colour")) return;
  if (const Result<Colour> colour = parse_colour(element.text("colour").value_or("")))
    walker.colour = *colour;
  else
    element.error_at("colour", world_codes::kBadWalker, colour.error().message);
}

}  // namespace

Walker read_walker(const xml::Attributes& element) {
  Walker walker;
  set(walker.name, element.name("name"));
  read_track(element, walker);
  set(walker.speed, element.number_or("speed", walker.speed));
  set(walker.radius, element.number_or("radius", walker.radius));
  set(walker.height, element.number_or("height", walker.height));
  if (element.has("loop")) walker.round = element.choice("loop") == "round";
  set(walker.pause, element.duration_or("pause", walker.pause));
  if (element.has("start")) walker.start = element.duration("start");
  if (element.has("seed")) walker.seed = element.integer("seed");
  check_limits(element, walker);
  set(walker.stops, element.number_or("stops", walker.stops));
  set(walker.yields, element.number_or("yields", walker.yields));
  set(walker.legs, element.number_or("legs", walker.legs));
  read_colour(element, walker);
  if (walker.legs > kWidestLegs * walker.radius)
    element.error_at(
        "legs", world_codes::kBadWalker,
        "two legs side by side have at most 0.8 times the walker's radius, or they would overlap");
  return walker;
}

const Obstacle* obstacle_on_track(const Walker& walker, const WorldModel& world) {
  const std::vector<Vec2>& track = walker.track;
  const std::size_t legs = track.empty() ? 0 : walker.round ? track.size() : track.size() - 1;
  for (std::size_t i = 0; i < legs; ++i) {
    const Vec2 from = track[i];
    const Vec2 to = track[(i + 1) % track.size()];
    const Obstacle* const at_corner = world.obstacle_at(Circle{from, walker.radius}, 0.0, walker.height);
    if (at_corner != nullptr) return at_corner;
    const Obstacle* const at_end = world.obstacle_at(Circle{to, walker.radius}, 0.0, walker.height);
    if (at_end != nullptr) return at_end;
    if (from == to) continue;
    if (const Obstacle* o = world.obstacle_at(swept(from, to, walker.radius), 0.0, walker.height)) return o;
  }
  return nullptr;
}

}  // namespace orca::sim::detail
