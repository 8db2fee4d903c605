// SPDX-License-Identifier: LGPL-3.0-or-later
#include "physics.hpp"

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <new>
#include <optional>
#include <utility>

#include "contact_solver.hpp"
#include "encounter.hpp"
#include "moving_body.hpp"
#include "solid_index.hpp"

namespace orca::sim::detail {
namespace {

constexpr double kGravity = 9.81;   // [m/s2]
constexpr double kRest = 1e-5;      // [m] Bodies that are pushed together stay that far apart.
constexpr double kFelt = 0.002;     // [m] What is so near is listed by touches().
constexpr double kImmovable = 1e9;  // [kg] and [kg m2] Of what is fixed to the building.
constexpr int kMostParts = 16;      // Parts of a step that is cut by touches.

// Bullet uses what it gets without a look.
void* allocate(std::size_t size) {
  void* const memory = std::malloc(size);
  return memory != nullptr ? memory : throw std::bad_alloc();
}

// Bullet's own functions are malloc() and free(), so it does not matter what was allocated before.
void report_lack_of_memory() { btAlignedAllocSetCustom(allocate, std::free); }

struct RobotBody {
  explicit RobotBody(const RobotModel& robot)
      : outline(robot.parts),
        mass(robot.fixed ? kImmovable : robot.mass),
        yaw_inertia(robot.fixed ? kImmovable : robot.yaw_inertia),
        drive(robot.drive),
        fixed(robot.fixed) {}

  RobotOutline outline;
  MovingBody body;
  double mass, yaw_inertia;
  orca::sim::Drive drive;
  bool fixed;
  Drift wanted;
  bool touches = false;  // In the present part of the step.
  std::vector<Touch> felt;
  btDbvtNode* leaf = nullptr;

  [[nodiscard]] Grip grip(const ErrorLevels& estimates) const;
};

// The forces of motors and wheels. Wheels stand still against a wall rather than spin.
Grip RobotBody::grip(const ErrorLevels& estimates) const {
  const double slides = wanted.grip * estimates.wheel_grip * mass * kGravity;
  const double harder = std::max(estimates.motor_force * drive.max_acceleration, drive.stop_deceleration);
  const double motors = std::min(slides, mass * harder);
  const double turns =
      std::max(0.5 * drive.track * motors, estimates.motor_force * yaw_inertia * drive.max_turn_acceleration);
  return {.velocity = wanted.velocity,
          .turn = wanted.turn,
          .heading = wanted.heading,
          .drives = motors,
          .turns = turns,
          .slides = slides,
          .rolls_sideways = drive.kind == DriveKind::holonomic};
}

struct MoverBody {
  std::vector<Rounded> solids;  // In its own frame.
  double height = 0.0;          // [m]
  MovingBody body;
  std::optional<Pose2> goal;  // Of the next step.
  double progress = 0.0;
  bool is_held = false;  // In the present part of the step, because a robot cannot give way.
  btDbvtNode* leaf = nullptr;
};

Bounds around(const MovingBody& body, double margin) {
  Bounds area;
  area.add(Circle{body.pose.position(), body.reach + margin});
  return area;
}

// Calls a function with the numbers of the leaves that Bullet's tree finds.
template <class Visit>
struct LeafVisitor final : btDbvt::ICollide {
  explicit LeafVisitor(Visit v) : visit(std::move(v)) {}
  void Process(const btDbvtNode* leaf) override { visit(leaf->dataAsInt); }
  Visit visit;
};

}  // namespace

struct Physics::Impl {
  Impl(const WorldModel& world, const ErrorLevels& errors) : solids(world), estimates(errors) {}

  SolidIndex solids;
  ErrorLevels estimates;
  std::deque<RobotBody> robots;
  std::deque<MoverBody> movers;
  btDbvt moving;  // Robots by their numbers, movers by -1 - number.
  std::vector<Encounter> encounters;
  std::vector<double> speeds;  // [m/s] Of the robots, before what touches them was solved.
  std::map<Pair, double> near;

  btDbvtNode* enter(const MovingBody& body, int number);
  void move_leaf(btDbvtNode* leaf, const MovingBody& body, double margin);
  void set_off(double seconds);
  double part(double seconds, bool hold);
  void meet(double seconds, double margin);
  void meet_solids(std::size_t robot, double margin);
  void meet_triangle(const Solid& solid, Encounter& e);
  void meet_moving(std::size_t robot, double margin);
  [[nodiscard]] std::vector<int> moving_near(std::size_t robot, double margin);
  void meet_robot(std::size_t one, std::size_t other);
  void meet_mover(std::size_t robot, std::size_t mover);
  void find_touches();
  void choose_velocities(double seconds, bool hold);
  void solve(double seconds);
  [[nodiscard]] double fastest_beside(std::size_t robot) const;
  [[nodiscard]] double first_touch(double seconds) const;
  void advance(double seconds);
  void look_around();
  [[nodiscard]] double nearest(std::size_t robot, double margin);
};

btDbvtNode* Physics::Impl::enter(const MovingBody& body, int number) {
  btDbvtNode* const leaf = moving.insert(volume_of(around(body, 0.0)), nullptr);
  leaf->dataAsInt = number;
  return leaf;
}

void Physics::Impl::move_leaf(btDbvtNode* leaf, const MovingBody& body, double margin) {
  if (leaf == nullptr) return;  // A mover that was removed.
  btDbvtVolume volume = volume_of(around(body, margin));
  moving.update(leaf, volume);
}

// Begins a step: movers go evenly to their goals.
void Physics::Impl::set_off(double seconds) {
  for (MoverBody& m : movers) {
    m.progress = 0.0;
    const Pose2 goal = m.goal.value_or(m.body.pose);
    m.body.velocity = (1.0 / seconds) * (goal.position() - m.body.pose.position());
    m.body.turn = wrapped(goal.yaw - m.body.pose.yaw) / seconds;
    m.goal.reset();
  }
}

// --- Who may meet whom ------------------------------------------------------------------------------------

// Lists what may touch within so many seconds, or comes as near as the margin [m].
void Physics::Impl::meet(double seconds, double margin) {
  double fastest = 0.0;
  for (const RobotBody& r : robots)
    fastest = std::max(
        {fastest, r.body.speed(), norm(r.wanted.velocity) + std::fabs(r.wanted.turn) * r.body.reach});
  for (const MoverBody& m : movers) fastest = std::max(fastest, m.body.speed());
  // What is pushed gets no faster than what pushes it; twice that, because the push may turn it, too.
  const double way = 2.0 * fastest * seconds + margin;
  encounters.clear();
  for (RobotBody& r : robots) move_leaf(r.leaf, r.body, way);
  for (MoverBody& m : movers) move_leaf(m.leaf, m.body, way);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    meet_solids(i, way);
    meet_moving(i, way);
  }
}

void Physics::Impl::meet_solids(std::size_t robot, double margin) {
  RobotBody& r = robots[robot];
  if (r.fixed) return;  // It may be screwed to a wall.
  solids.visit(around(r.body, margin), [&](const Solid& solid) {
    Encounter e{{robot, Kind::obstacle, solid.obstacle}, &r.body, nullptr, nullptr, solid.plan};
    if (solid.triangle != nullptr) return meet_triangle(solid, e);
    for (const Rounded& own : r.outline.between(solid.bottom, solid.top)) {
      e.plan = &own;
      encounters.push_back(e);
    }
  });
}

// A sloping triangle has another plan at the heights of each of the robot's parts.
void Physics::Impl::meet_triangle(const Solid& solid, Encounter& e) {
  for (const Piece& piece : robots[e.pair.robot].outline.pieces()) {
    e.other_plan = plan_between(solid, piece.bottom, piece.top);
    if (e.other_plan.corners.empty()) continue;
    e.plan = &piece.plan;
    encounters.push_back(e);
  }
}

std::vector<int> Physics::Impl::moving_near(std::size_t robot, double margin) {
  std::vector<int> found;
  LeafVisitor visitor([&](int number) { found.push_back(number); });
  moving.collideTV(moving.m_root, volume_of(around(robots[robot].body, margin)), visitor);
  std::ranges::sort(found);  // The tree's order depends on how the bodies moved before.
  return found;
}

void Physics::Impl::meet_moving(std::size_t robot, double margin) {
  for (const int number : moving_near(robot, margin)) {
    if (number < 0) meet_mover(robot, static_cast<std::size_t>(-1 - number));
    if (number > static_cast<int>(robot)) meet_robot(robot, static_cast<std::size_t>(number));
  }
}

void Physics::Impl::meet_robot(std::size_t one, std::size_t other) {
  RobotBody& a = robots[one];
  RobotBody& b = robots[other];
  for (const Piece& piece : b.outline.pieces())
    for (const Rounded& own : a.outline.between(piece.bottom, piece.top))
      encounters.push_back({{one, Kind::robot, other}, &a.body, &b.body, &own, piece.plan});
}

void Physics::Impl::meet_mover(std::size_t robot, std::size_t mover) {
  RobotBody& r = robots[robot];
  MoverBody& m = movers[mover];
  for (const Rounded& plan : m.solids)
    for (const Rounded& own : r.outline.between(0.0, m.height))
      encounters.push_back({{robot, Kind::mover, mover}, &r.body, &m.body, &own, plan});
}

// --- How they go on ---------------------------------------------------------------------------------------

void Physics::Impl::find_touches() {
  for (RobotBody& r : robots) r.touches = false;
  for (Encounter& e : encounters) {
    e.touches = e.gap(0.0).distance <= kTouching;
    if (!e.touches) continue;
    robots[e.pair.robot].touches = true;
    if (e.pair.kind == Kind::robot) robots[e.pair.other].touches = true;
  }
}

// @param hold  whether movers that touch a robot stand, because they could not go on.
void Physics::Impl::choose_velocities(double seconds, bool hold) {
  for (RobotBody& r : robots) {
    if (r.touches) continue;
    r.body.velocity = r.wanted.velocity;
    r.body.turn = r.wanted.turn;
  }
  for (MoverBody& m : movers) m.is_held = false;
  if (hold)
    for (const Encounter& e : encounters)
      if (e.pair.kind == Kind::mover && e.touches) movers[e.pair.other].is_held = true;
  for (MoverBody& m : movers) {
    if (!m.is_held) continue;
    m.body.velocity = {};
    m.body.turn = 0.0;
  }
  if (std::ranges::any_of(robots, &RobotBody::touches)) solve(seconds);
}

void Physics::Impl::solve(double seconds) {
  ContactSolver solver(seconds, estimates.contact_friction);
  speeds.clear();
  for (const RobotBody& r : robots) speeds.push_back(norm(r.body.velocity));
  std::map<std::size_t, std::size_t> numbers;  // Of the robots that touch, in the solver.
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const RobotBody& r = robots[i];
    if (r.touches)
      numbers[i] = solver.add_base({r.body.pose, r.body.velocity, r.body.turn}, r.mass, r.yaw_inertia,
                                   r.grip(estimates));
  }
  std::map<std::size_t, std::size_t> carried;
  for (const Encounter& e : encounters) {
    if (!e.touches) continue;
    std::vector<Gap> touches;
    e.add_touches(kTouching, touches);
    std::size_t other = ContactSolver::kGround;
    if (e.pair.kind == Kind::robot) other = numbers.at(e.pair.other);
    if (e.pair.kind == Kind::mover) {
      const MovingBody& m = movers[e.pair.other].body;
      if (!carried.contains(e.pair.other))
        carried[e.pair.other] = solver.add_carried({m.pose, m.velocity, m.turn});
      other = carried[e.pair.other];
    }
    const Pose2& X_WR = e.one->pose;
    for (const Gap& gap : touches)
      solver.add_contact(numbers.at(e.pair.robot), other, X_WR.position() + rotated(gap.on_one, X_WR.yaw),
                         rotated(gap.normal, X_WR.yaw), gap.distance - kRest);
  }
  solver.solve();
  for (const auto& [robot, number] : numbers) {
    robots[robot].body.velocity = shortened(solver.velocity(number), fastest_beside(robot));
    robots[robot].body.turn = solver.turn(number);
  }
}

// Returns the largest speed among a robot's own, that which its wheels want, and those of what touches it. Wheels that
// roll only one way would turn an oblique push into a faster escape, like a wedge; what brakes them in life, such as
// gears and the floor, is not modelled otherwise.
double Physics::Impl::fastest_beside(std::size_t robot) const {
  double fastest = std::max(norm(robots[robot].wanted.velocity), speeds[robot]);
  for (const Encounter& e : encounters) {
    if (!e.touches) continue;
    if (e.pair.robot == robot && e.pair.kind == Kind::mover)
      fastest = std::max(fastest, norm(movers[e.pair.other].body.velocity));
    if (e.pair.kind != Kind::robot) continue;
    if (e.pair.robot == robot) fastest = std::max(fastest, speeds[e.pair.other]);
    if (e.pair.other == robot) fastest = std::max(fastest, speeds[e.pair.robot]);
  }
  return fastest;
}

// Returns how long the bodies can go on like this until something else touches, or comes too close.
double Physics::Impl::first_touch(double seconds) const {
  for (const Encounter& e : encounters)
    seconds = e.time_of_gap(e.touches ? -kTouching : 0.5 * kTouching, seconds);
  return seconds;
}

void Physics::Impl::advance(double seconds) {
  for (RobotBody& r : robots) r.body.pose = r.body.at(seconds);
  for (MoverBody& m : movers) {
    m.body.pose = m.body.at(seconds);
    if (!m.is_held) m.progress += seconds;
  }
}

// Moves all bodies by a part of a step. @return  its duration.
double Physics::Impl::part(double seconds, bool hold) {
  meet(seconds, 0.0);
  find_touches();
  choose_velocities(seconds, hold);
  const double free = first_touch(seconds);
  advance(free);
  return free;
}

// Notes what is near at the end of a step.
void Physics::Impl::look_around() {
  meet(0.0, kNear);
  near.clear();
  for (RobotBody& r : robots) r.felt.clear();
  const auto note = [&](const Pair& pair, double distance) {
    const auto [found, is_new] = near.emplace(pair, distance);
    if (!is_new) found->second = std::min(found->second, distance);
  };
  for (const Encounter& e : encounters) {
    const double distance = e.gap(0.0).distance;
    if (distance > kNear) continue;
    note(e.pair, distance);
    if (e.pair.kind == Kind::robot) note({e.pair.other, Kind::robot, e.pair.robot}, distance);
    std::vector<Gap> touches;
    e.add_touches(kFelt, touches);
    for (const Gap& gap : touches) {
      robots[e.pair.robot].felt.push_back({gap.on_one, gap.distance});
      if (e.pair.kind == Kind::robot)
        robots[e.pair.other].felt.push_back(
            {(inverse(e.other->pose) * e.one->pose) * gap.on_other, gap.distance});
    }
  }
}

// Returns the distance to the nearest of the things that come as near as the margin [m]; the margin if none does.
double Physics::Impl::nearest(std::size_t robot, double margin) {
  encounters.clear();
  meet_solids(robot, margin);
  for (const int number : moving_near(robot, margin)) {
    if (number < 0) meet_mover(robot, static_cast<std::size_t>(-1 - number));
    if (number >= 0 && number != static_cast<int>(robot)) meet_robot(robot, static_cast<std::size_t>(number));
  }
  double least = margin;
  for (const Encounter& e : encounters) least = std::min(least, e.gap(0.0).distance);
  return least;
}

Physics::Physics(const WorldModel& world, const ErrorLevels& errors)
    : impl_((report_lack_of_memory(), std::make_unique<Impl>(world, errors))) {}
Physics::~Physics() = default;

std::size_t Physics::add_robot(const RobotModel& model, const Pose2& X_WB) {
  RobotBody& r = impl_->robots.emplace_back(model);
  r.body.pose = X_WB;
  r.body.reach = r.outline.reach();
  r.leaf = impl_->enter(r.body, static_cast<int>(impl_->robots.size() - 1));
  return impl_->robots.size() - 1;
}

std::size_t Physics::add_mover(const Shape& shape, double height, const Pose2& X_WO) {
  MoverBody& m = impl_->movers.emplace_back();
  m.solids = solids_of(shape);
  m.height = height;
  m.body.pose = X_WO;
  for (const Rounded& plan : m.solids) m.body.reach = std::max(m.body.reach, reach_of(plan));
  m.leaf = impl_->enter(m.body, -static_cast<int>(impl_->movers.size()));
  return impl_->movers.size() - 1;
}

void Physics::place_mover(std::size_t mover, const Pose2& X_WO) {
  MoverBody& m = impl_->movers[mover];
  m.body.pose = X_WO;
  m.goal.reset();
}

void Physics::carry_mover(std::size_t mover, const Pose2& X_WO) { impl_->movers[mover].goal = X_WO; }

void Physics::remove_mover(std::size_t mover) {
  MoverBody& m = impl_->movers[mover];
  if (m.leaf == nullptr) return;
  impl_->moving.remove(m.leaf);
  m = {};
}

Pose2 Physics::mover_pose(std::size_t mover) const { return impl_->movers[mover].body.pose; }
double Physics::mover_progress(std::size_t mover) const { return impl_->movers[mover].progress; }

void Physics::place_robot(std::size_t robot, const Pose2& X_WB) { impl_->robots[robot].body.pose = X_WB; }

void Physics::drive(std::size_t robot, const Drift& drift) { impl_->robots[robot].wanted = drift; }

void Physics::step(double seconds) {
  impl_->set_off(seconds);
  // What is left after so many parts is lost for all bodies: less than a tick, where many press each other.
  double left = seconds;
  for (int parts = 0; left > 0.0 && parts < 2 * kMostParts; ++parts)
    left -= impl_->part(left, parts >= kMostParts);
  for (MoverBody& m : impl_->movers) m.progress /= seconds;
  impl_->look_around();
}

Pose2 Physics::pose(std::size_t robot) const { return impl_->robots[robot].body.pose; }
const std::map<Pair, double>& Physics::near_pairs() const { return impl_->near; }
const std::vector<Touch>& Physics::touches(std::size_t robot) const { return impl_->robots[robot].felt; }

// Most of the time something is near, so a wide look at all that stands around is rare.
double Physics::clearance(std::size_t robot, double limit) const {
  constexpr double kFirstLook = 0.25;  // [m]
  for (double margin = std::min(kFirstLook, limit);; margin = std::min(2.0 * margin, limit)) {
    const double found = impl_->nearest(robot, margin);
    if (found < margin || margin >= limit) return found;
  }
}

}  // namespace orca::sim::detail
