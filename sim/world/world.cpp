// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/world.hpp"

#include <algorithm>
#include <deque>
#include <utility>

#include "arc.hpp"
#include "contact_log.hpp"
#include "physics.hpp"
#include "robot.hpp"

namespace orca::sim {
namespace {

constexpr double kFarthest = 1e5;  // [m]

std::size_t index(RobotId id) { return static_cast<std::size_t>(id); }

std::string text(const Pose2& pose) {
  const auto number = [](double v) {
    std::string s = std::to_string(v);
    return s.substr(0, s.find('.') + 3);
  };
  return "(" + number(pose.x) + ", " + number(pose.y) + ") m";
}

}  // namespace

struct World::Impl {
  Impl(WorldModel m, Options o)
      : model(std::move(m)), options(o), errors(error_levels(o.realism)), caster(model), physics(model) {}

  WorldModel model;
  Options options;
  ErrorLevels errors;
  Caster caster;
  detail::Physics physics;
  detail::ContactLog contact_log;
  std::deque<detail::Robot> robots;  // Robots do not move in memory. Same numbers as in caster and physics.
  detail::SonarAir air;
  std::vector<ContactEvent> contacts;
  TimePoint now{};

  [[nodiscard]] detail::Robot& robot(RobotId id) { return robots.at(index(id)); }
  [[nodiscard]] Status check_birth(const std::string& name, const RobotModel& model, const Pose2& X_WB) const;
  void drive();
  void report_contacts();
  void move();
  void sense();
};

Status World::Impl::check_birth(const std::string& name, const RobotModel& robot_model,
                                const Pose2& X_WB) const {
  if (name.empty()) return fail(Code::invalid_argument, "a robot needs a name");
  const std::string who = "robot '" + name + "'";
  const bool near = std::fabs(X_WB.x) <= kFarthest && std::fabs(X_WB.y) <= kFarthest;
  if (!near || !std::isfinite(X_WB.yaw))
    return fail(Code::invalid_argument, who + ": its start pose is not finite or beyond 100 km");
  const std::string there = who + " cannot start at " + text(X_WB) + ": it would stand in ";
  const std::string remedy = "; choose a free place";
  const Shape body = placed(robot_model.footprint, X_WB);
  for (const detail::Robot& other : robots) {
    if (other.name == name)
      return fail(Code::already_exists, "there is a " + who + " already; choose another name");
    if (overlap(body, placed(other.model.footprint, other.body)))
      return fail(Code::failed_precondition, there + "robot '" + other.name + "'" + remedy);
  }
  if (const Obstacle* o = model.obstacle_at(body, robot_model.bottom, robot_model.top))
    return fail(Code::failed_precondition,
                there + "obstacle '" + o->name + "' of world '" + model.name + "'" + remedy);
  return ok();
}

// Bullet moves a body straight for a tick; the chord of the arc makes that exact.
void World::Impl::drive() {
  const double seconds = to_seconds(kTick);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    detail::Robot& r = robots[i];
    const Vec2 way = detail::chord(r.pose.yaw, r.set_off());
    physics.set_velocity(i, (1.0 / seconds) * way, r.body_turn());
  }
  physics.step(seconds);
  now += kTick;
}

void World::Impl::report_contacts() {
  contacts.clear();
  for (const detail::Pair& p : contact_log.update(physics.near_pairs())) {
    const detail::Robot& r = robots[p.robot];
    const std::string& other = p.other_is_robot ? robots[p.other].name : model.obstacles[p.other].name;
    contacts.push_back({r.name, now, other, r.speed()});
  }
}

void World::Impl::move() {
  for (std::size_t i = 0; i < robots.size(); ++i) {
    detail::Robot& r = robots[i];
    r.moved(physics.pose(i), now, contact_log.touches(i));
    caster.move_body(i, placed(r.model.footprint, r.body));
  }
}

void World::Impl::sense() {
  air.settle(now - kTick);
  for (std::size_t i = 0; i < robots.size(); ++i) robots[i].chirp(caster, air, i);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    robots[i].sense(caster, air, i);
    if (!robots[i].bumpers.empty()) robots[i].feel(physics.touches(i));
  }
}

World::World(WorldModel model, Options options) : impl_(std::make_unique<Impl>(std::move(model), options)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

Result<RobotId> World::add_robot(const std::string& name, const RobotModel& model, const Pose2& X_WB) {
  if (const Status s = impl_->check_birth(name, model, X_WB); !s) return s.error();
  impl_->robots.emplace_back(detail::Robot::Birth{name, X_WB, impl_->now, impl_->options.seed, kTick}, model,
                             impl_->errors);
  impl_->physics.add_robot(model, X_WB);
  return RobotId{impl_->caster.add_body({placed(model.footprint, X_WB), model.bottom, model.top})};
}

std::optional<RobotId> World::find(std::string_view name) const {
  const auto found = std::ranges::find(impl_->robots, name, &detail::Robot::name);
  if (found == impl_->robots.end()) return std::nullopt;
  return RobotId{static_cast<std::size_t>(found - impl_->robots.begin())};
}

Status World::set_velocity_command(RobotId robot, double forward, double turn) {
  return set_velocity_command(robot, Velocity{.forward = forward, .turn = turn});
}

Status World::set_velocity_command(RobotId robot, const Velocity& wanted) {
  detail::Robot& r = impl_->robot(robot);
  if (!std::isfinite(wanted.forward) || !std::isfinite(wanted.turn) || !std::isfinite(wanted.left))
    return fail(Code::invalid_argument, "a velocity command must be finite", r.name);
  if (wanted.left != 0.0 && r.model.drive.kind != DriveKind::holonomic)
    return fail(Code::failed_precondition, "this base cannot move sideways; only a holonomic one can",
                r.name);
  r.drive.command(wanted);
  return ok();
}

Status World::set_turret_command(RobotId robot, double angle) {
  detail::Robot& r = impl_->robot(robot);
  if (!r.model.turret) return fail(Code::failed_precondition, "this robot has no turret", r.name);
  if (!std::isfinite(angle)) return fail(Code::invalid_argument, "a turret's angle must be finite", r.name);
  r.drive.point_turret(angle);
  return ok();
}

void World::step() {
  impl_->drive();
  impl_->report_contacts();
  impl_->move();
  impl_->sense();
}

TimePoint World::time() const { return impl_->now; }
Pose2 World::pose(RobotId robot) const { return impl_->robot(robot).pose; }
Pose2 World::body_pose(RobotId robot) const { return impl_->robot(robot).body; }
std::optional<TurretReading> World::turret(RobotId robot) const { return impl_->robot(robot).turret(); }
Velocity World::velocity(RobotId robot) const { return impl_->robot(robot).velocity; }
const std::vector<ContactEvent>& World::contacts() const { return impl_->contacts; }
const std::optional<SonarScan>& World::sonar(RobotId robot, std::size_t ring) const {
  return impl_->robot(robot).sonars.at(ring).completed();
}
const std::optional<LaserScan>& World::laser(RobotId robot, std::size_t laser) const {
  return impl_->robot(robot).lasers.at(laser).completed();
}
const std::optional<InfraredScan>& World::infrared(RobotId robot, std::size_t ring) const {
  return impl_->robot(robot).infrareds.at(ring).completed();
}
const std::optional<BumperReading>& World::bumper(RobotId robot, std::size_t ring) const {
  return impl_->robot(robot).bumpers.at(ring).completed();
}
const std::optional<OdometryReading>& World::odometry(RobotId robot) const {
  return impl_->robot(robot).odometry;
}
const WorldModel& World::model() const { return impl_->model; }
const RobotModel& World::robot_model(RobotId robot) const { return impl_->robot(robot).model; }
const Caster& World::caster() const { return impl_->caster; }

Scene World::scene() const {
  Scene scene = scene_of(impl_->model);
  for (const detail::Robot& r : impl_->robots) scene.robots.push_back(r.drawn());
  return scene;
}

std::uint64_t World::state_hash() const {
  Fnv1a hash;
  hash.add_u64(static_cast<std::uint64_t>(impl_->now.time_since_epoch().count()));
  for (const detail::Robot& r : impl_->robots) r.add_to(hash);
  return hash.value();
}

}  // namespace orca::sim
