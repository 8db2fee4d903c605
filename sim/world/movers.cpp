// SPDX-License-Identifier: LGPL-3.0-or-later
#include "movers.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace orca::sim::detail {
namespace {

bool in_the_way(const Robot& robot, const WalkerTrack::Place& place, double radius, double stops) {
  if (dot(robot.pose.position() - place.position, place.ahead) <= 0.0) return false;
  return distance(placed(robot.model.footprint, robot.body), place.position) < radius + stops;
}

constexpr double kWhole =
    1.0 - 1e-9;  // A share of a tick is a sum, and as little less than 1 as its roundings.

constexpr double kSight = 4.0;       // [m] How far ahead a walker that steps aside looks.
constexpr double kRoom = 0.3;        // [m] That it wants beside whom it passes.
constexpr double kMostAside = 0.8;   // [m] It does not leave its track by more.
constexpr double kHeadOn = 0.05;     // [m] Somebody so little to its right counts as straight ahead.
constexpr double kOnTrack = 1e-6;    // [m] Nothing stands so near to a track.
constexpr double kAsideShare = 0.5;  // Of its speed with which it steps aside.

constexpr double kStep = 0.65;   // [m] Way from the step of one leg to that of the other.
constexpr double kCrotch = 0.5;  // Height of its legs as a share of its height.

// Returns how far a leg is ahead, as a share of its swing: a triangle wave that begins at 0.
double swing(double way) {
  const double phase = std::remainder(way / kStep, 2.0);
  return std::fabs(phase) <= 0.5 ? 2.0 * phase : std::copysign(2.0, phase) - 2.0 * phase;
}

Vec2 left_of(Vec2 ahead) { return {-ahead.y, ahead.x}; }

Pose2 standing(Vec2 position) { return {position.x, position.y, 0.0}; }

}  // namespace

Movers::Movers(const WorldModel& world, std::uint64_t run_seed, Caster& caster, Physics& physics)
    : world_(world), caster_(caster), physics_(physics) {
  for (const Walker& walker : world.walkers) {
    WalkerTrack track(walker, run_seed);
    const Pose2 begin = standing(track.at({}).position);
    const std::size_t number =
        add(walker.name, Circle{{}, walker.radius}, walker.height, begin, walker.colour);
    movers_[number].walk = Walk{std::move(track), walker.stops, walker.speed};
    movers_[number].walk->yields = walker.yields;
    movers_[number].walk->legs = walker.legs;
    movers_[number].walk->ahead = movers_[number].walk->track.at({}).ahead;
    if (movers_[number].has_legs()) caster_.move_solids(movers_[number].body, movers_[number].figure());
  }
}

std::size_t Movers::add(const std::string& name, Shape shape, double height, const Pose2& X_WO,
                        Colour colour) {
  const std::size_t number = physics_.add_mover(shape, height, X_WO);
  Mover mover{name, std::move(shape), height, X_WO, colour};
  mover.body = caster_.add_body({mover.placed(), 0.0, height, colour});
  movers_.push_back(std::move(mover));
  return number;
}

void Movers::move(std::size_t number, const Pose2& X_WO) {
  Mover& mover = movers_.at(number);
  mover.pose = X_WO;
  caster_.move_body(mover.body, mover.placed());
  physics_.place_mover(number, X_WO);
}

void Movers::remove(std::size_t number) {
  Mover& mover = movers_.at(number);
  mover.present = false;
  caster_.remove_body(mover.body);
  physics_.remove_mover(number);
}

void Movers::set_off(Duration tick, const std::deque<Robot>& robots) {
  for (std::size_t number = 0; number < movers_.size(); ++number) {
    Mover& mover = movers_[number];
    if (!mover.walk) continue;
    Walk& walk = *mover.walk;
    const auto here = walk.track.at(walk.walked);
    const double radius = std::get<Circle>(mover.shape).radius;
    const bool blocked = walk.stops > 0.0 && std::ranges::any_of(robots, [&](const Robot& robot) {
                           return in_the_way(robot, here, radius, walk.stops);
                         });
    walk.sets_off = !blocked;
    walk.pace = 0.0;
    if (blocked) continue;
    const Vec2 step = next_step(mover, number, tick, robots);
    walk.pace = norm(step) / to_seconds(tick);
    physics_.carry_mover(number, standing(mover.pose.position() + step));
  }
}

// Returns whom a walker sees: robots as the circles that hold them, and other walkers where their tracks are. So two who make
// room for each other do not count on what the other has made already.
std::vector<Movers::Other> Movers::others(std::size_t number, const std::deque<Robot>& robots) const {
  std::vector<Other> found;
  for (std::size_t k = 0; k < movers_.size(); ++k)
    if (k != number && movers_[k].walk)
      found.push_back({movers_[k].walk->track.at(movers_[k].walk->walked).position,
                       std::get<Circle>(movers_[k].shape).radius});
  for (const Robot& robot : robots) found.push_back({robot.body.position(), robot.model.radius});
  return found;
}

// Returns how far to the left [m] of its track a walker wants to be, because of the nearest one ahead whom it would pass
// without room. It makes its share of the room on the side that is free, and keeps right of who comes straight on.
double Movers::wanted_aside(std::size_t number, const std::deque<Robot>& robots) const {
  const Mover& mover = movers_[number];
  const auto place = mover.walk->track.at(mover.walk->walked);
  const double radius = std::get<Circle>(mover.shape).radius;
  double nearest = kSight;
  double aside = 0.0;
  for (const Other& other : others(number, robots)) {
    const double along = dot(other.position - mover.pose.position(), place.ahead);
    const double across = dot(other.position - place.position, left_of(place.ahead));
    const double lacking = radius + other.radius + kRoom - std::fabs(across);
    if (along <= -radius || along >= nearest || lacking <= 0.0) continue;
    nearest = along;
    aside = (across > -kHeadOn ? -1.0 : 1.0) * mover.walk->yields * lacking;
  }
  return std::clamp(aside, -kMostAside, kMostAside);
}

// Returns the way of a walker in this tick. One that a robot held in a corner of its track stands a little beside it, and
// does not run to be back on it. For one that steps aside the track waits as long as it is behind.
Vec2 Movers::next_step(Mover& mover, std::size_t number, Duration tick,
                       const std::deque<Robot>& robots) const {
  Walk& walk = *mover.walk;
  const double longest = walk.speed * to_seconds(tick);
  const Vec2 here = mover.pose.position();
  walk.advance = tick;
  if (walk.yields == 0.0) return shortened(walk.track.at(walk.walked + tick).position - here, longest);
  const auto place = walk.track.at(walk.walked);
  const Vec2 left = left_of(place.ahead);
  const double now = dot(here - place.position, left);
  if (dot(place.position - here, place.ahead) > longest) walk.advance = Duration{0};
  const double sideways = kAsideShare * longest;
  const double step = std::clamp(wanted_aside(number, robots) - now, -sideways, sideways);
  const Vec2 on_track = walk.track.at(walk.walked + walk.advance).position;
  const Vec2 on = shortened(on_track + now * left - here, std::sqrt(longest * longest - step * step));
  const Vec2 way = shortened(on + step * left, longest);
  if (std::fabs(now + step) < kOnTrack) return way;
  const double radius = std::get<Circle>(mover.shape).radius;
  if (world_.obstacle_at(Circle{here + way, radius}, 0.0, mover.height) == nullptr) return way;
  return shortened(on_track - here, longest);
}

// A walker that was held by a robot takes up its track where it stands.
void Movers::arrive() {
  for (std::size_t number = 0; number < movers_.size(); ++number) {
    Mover& mover = movers_[number];
    if (!mover.walk || !mover.walk->sets_off) continue;
    Walk& walk = *mover.walk;
    const double share = physics_.mover_progress(number);
    walk.walked += share > kWhole ? walk.advance
                                  : Duration(std::llround(share * static_cast<double>(walk.advance.count())));
    const Vec2 before = mover.pose.position();
    mover.pose = physics_.mover_pose(number);
    if (!mover.has_legs()) {
      caster_.move_body(mover.body, mover.placed());
      continue;
    }
    walk.way += norm(mover.pose.position() - before);
    walk.ahead = walk.track.at(walk.walked).ahead;
    caster_.move_solids(mover.body, mover.figure());
  }
}

// The legs swing as far as the cylinder has room for them, and in opposite directions.
std::array<Circle, 2> Movers::Mover::legs() const {
  const double radius = 0.5 * walk->legs;
  const double room = std::get<Circle>(shape).radius - radius;
  const double aside = Walker::kHip * std::get<Circle>(shape).radius;
  const Vec2 left = aside * left_of(walk->ahead);
  const Vec2 on = swing(walk->way) * std::sqrt(room * room - aside * aside) * walk->ahead;
  return {Circle{pose.position() + left + on, radius}, Circle{pose.position() - left - on, radius}};
}

std::vector<Body> Movers::Mover::figure() const {
  const double crotch = kCrotch * height;
  const auto both = legs();
  return {{both[0], 0.0, crotch, colour}, {both[1], 0.0, crotch, colour}, {placed(), crotch, height, colour}};
}

std::optional<double> Movers::walking_speed(std::size_t number) const {
  const std::optional<Walk>& walk = movers_.at(number).walk;
  return walk ? std::optional(walk->pace) : std::nullopt;
}

std::vector<Person> Movers::people() const {
  std::vector<Person> people;
  for (const Mover& m : movers_)
    if (m.walk) people.push_back({m.name, m.pose.position(), std::get<Circle>(m.shape).radius, m.walk->pace});
  return people;
}

bool Movers::is_obstacle(std::size_t number) const {
  return number < movers_.size() && movers_[number].present && !movers_[number].walk;
}

bool Movers::has_name(const std::string& name) const {
  return std::ranges::any_of(movers_, [&](const Mover& m) { return m.present && m.name == name; });
}

Body Movers::body_at(std::size_t number, const Pose2& X_WO) const {
  const Mover& mover = movers_.at(number);
  return {placed(mover.shape, X_WO), 0.0, mover.height};
}

const std::string* Movers::at(const Shape& body, double bottom) const {
  const auto found = std::ranges::find_if(
      movers_, [&](const Mover& m) { return m.present && m.height > bottom && overlap(body, m.placed()); });
  return found == movers_.end() ? nullptr : &found->name;
}

void Movers::draw(Snapshot& snapshot) const {
  for (const Mover& m : movers_) {
    if (!m.present) continue;
    const Shape shape = m.placed();
    if (const auto* circle = std::get_if<Circle>(&shape)) snapshot.circles.push_back(*circle);
    if (m.has_legs())
      for (const Circle& leg : m.legs()) snapshot.circles.push_back(leg);
    const std::vector<Segment> edges = edges_of(shape);
    snapshot.edges.insert(snapshot.edges.end(), edges.begin(), edges.end());
    const Bounds b = bounds_of(shape);
    snapshot.bounds.add(b.low);
    snapshot.bounds.add(b.high);
  }
}

void Movers::add_to(Fnv1a& hash) const {
  for (const Mover& m : movers_) {
    if (!m.present) continue;
    for (const double value : {m.pose.x, m.pose.y, m.pose.yaw})
      hash.add_u64(std::bit_cast<std::uint64_t>(value));
    if (m.has_legs()) hash.add_u64(std::bit_cast<std::uint64_t>(m.walk->way));
  }
}

}  // namespace orca::sim::detail
