// SPDX-License-Identifier: LGPL-3.0-or-later
#include "items.hpp"

#include <algorithm>
#include <bit>

namespace orca::sim::detail {
namespace {

// [m] Paddles that grip an item at the root pull it so far away from there that it does not touch the body.
constexpr double kOffRoot = 0.001;

constexpr double kInner = 0.25;  // Places of the beams, as shares of the depth.
constexpr double kOuter = 0.75;

}  // namespace

Items::Items(const WorldModel& world, std::deque<Robot>& robots, Movers& movers)
    : world_(world), robots_(robots), movers_(movers) {
  for (const Item& item : world.items) {
    Thing& thing = things_.emplace_back(Thing{item, item.pose});
    thing.mover = movers_.add(item.name, thing.plan(), item.height, item.pose);
  }
}

void Items::handle(Duration tick, std::vector<std::string>& notes) {
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    if (!robots_[i].gripper) continue;
    GripperModel& gripper = *robots_[i].gripper;
    if (gripper.wants_to_let_go()) notes.push_back(let_go(i));
    Thing* const thing = between_paddles(i);
    const auto width = thing != nullptr ? std::optional(thing->width()) : std::nullopt;
    if (!gripper.step(to_seconds(tick), width)) continue;
    take(*thing, i);
    notes.push_back(robots_[i].name + " has taken '" + thing->item.name + "'");
  }
}

Pose2 Items::gripper_pose(std::size_t robot) const {
  return robots_[robot].body * robots_[robot].model.gripper->mount;
}

Pose2 Items::pose(const Thing& thing) const {
  return thing.in ? gripper_pose(thing.in->robot) * Pose2{thing.in->ahead, 0.0, 0.0} : thing.pose;
}

// The paddles meet the widest first, and of equal ones that at the root. They are not solid: one that is wider than the
// gap already does not stop them.
Items::Thing* Items::between_paddles(std::size_t robot) {
  const GripperModel& paddles = *robots_[robot].gripper;
  if (!paddles.is_low()) return nullptr;
  const Gripper& gripper = *robots_[robot].model.gripper;
  const Pose2 X_WG = gripper_pose(robot);
  Thing* first = nullptr;
  double first_ahead = 0.0;
  for (Thing& thing : things_) {
    if (thing.in || thing.width() > paddles.gap()) continue;
    const Vec2 p = seen_from(X_WG, thing.pose.position());
    if (p.x < 0.0 || p.x > gripper.depth || std::fabs(p.y) > 0.5 * gripper.opening) continue;
    const bool is_first = first == nullptr || thing.width() > first->width() ||
                          (thing.width() == first->width() && p.x < first_ahead);
    if (!is_first) continue;
    first = &thing;
    first_ahead = p.x;
  }
  return first;
}

void Items::take(Thing& thing, std::size_t robot) {
  const double ahead = seen_from(gripper_pose(robot), thing.pose.position()).x;
  movers_.remove(thing.mover);
  thing.in = Grasp{robot, std::max(ahead, thing.item.radius + kOffRoot)};
}

std::string Items::let_go(std::size_t robot) {
  GripperModel& gripper = *robots_[robot].gripper;
  const auto holds = [&](const Thing& t) { return t.in && t.in->robot == robot; };
  Thing& thing = *std::ranges::find_if(things_, holds);
  const Pose2 X_WI = pose(thing);
  const std::string what = " '" + thing.item.name + "' at " + text(X_WI);
  if (const std::string other = in_the_way(thing, X_WI); !other.empty()) {
    gripper.refuse();
    return robots_[robot].name + " cannot put down" + what + ": " + other +
           " is there; the paddles stay closed";
  }
  gripper.let_go();
  thing.pose = X_WI;
  thing.in.reset();
  thing.mover = movers_.add(thing.item.name, thing.plan(), thing.item.height, X_WI);
  return robots_[robot].name + (gripper.lift() > 0.0 ? " has dropped" : " has put down") + what;
}

std::string Items::in_the_way(const Thing& thing, const Pose2& X_WI) const {
  const Shape plan = placed(thing.plan(), X_WI);
  if (const Obstacle* const o = world_.obstacle_at(plan, 0.0, thing.item.height))
    return "obstacle '" + o->name + "'";
  if (const Robot* const other = robot_at(robots_, {plan, 0.0, thing.item.height}))
    return "robot '" + other->name + "'";
  const std::string* const mover = movers_.at(plan, 0.0);
  return mover != nullptr ? "'" + *mover + "'" : "";
}

bool Items::interrupts_beam(const Thing& thing, std::size_t robot, double share) const {
  const GripperModel& paddles = *robots_[robot].gripper;
  if (thing.in ? thing.in->robot != robot : !paddles.is_low()) return false;
  const double x = share * robots_[robot].model.gripper->depth;
  const double half = 0.5 * paddles.gap();
  const Vec2 p = seen_from(gripper_pose(robot), pose(thing).position());
  return norm(p - nearest_point({{x, -half}, {x, half}}, p)) <= thing.item.radius;
}

GripperReading Items::reading(std::size_t robot, TimePoint now) const {
  const GripperModel& g = *robots_[robot].gripper;
  const auto sees = [&](double share) {
    return std::ranges::any_of(things_, [&](const Thing& t) { return interrupts_beam(t, robot, share); });
  };
  return {.stamp = now,
          .opening = g.opening(),
          .is_open = g.opening() == 1.0,
          .is_closed = g.opening() == 0.0,
          .paddles_move = g.paddles_move(),
          .lift = g.lift(),
          .lift_moves = g.lift_moves(),
          .inner_beam = sees(kInner),
          .outer_beam = sees(kOuter),
          .holds = g.holds()};
}

std::optional<Pose2> Items::pose(std::string_view name) const {
  const auto found = std::ranges::find_if(things_, [&](const Thing& t) { return t.item.name == name; });
  if (found == things_.end()) return std::nullopt;
  return pose(*found);
}

bool Items::is_mover(std::size_t number) const {
  return std::ranges::any_of(things_, [&](const Thing& t) { return !t.in && t.mover == number; });
}

void Items::draw(Snapshot& snapshot) const {
  for (const Thing& thing : things_)
    if (thing.in) {
      snapshot.circles.push_back({pose(thing).position(), thing.item.radius});
      const Bounds b = bounds_of(snapshot.circles.back());
      snapshot.bounds.add(b.low);
      snapshot.bounds.add(b.high);
    }
}

void Items::add_to(Fnv1a& hash) const {
  for (const Thing& thing : things_) {
    const Pose2 X_WI = pose(thing);
    for (const double value : {X_WI.x, X_WI.y, X_WI.yaw}) hash.add_u64(std::bit_cast<std::uint64_t>(value));
    hash.add_u64(thing.in ? 1 + thing.in->robot : 0);
  }
}

}  // namespace orca::sim::detail
