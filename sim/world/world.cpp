// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/world.hpp"

#include <algorithm>
#include <deque>
#include <set>
#include <utility>

#include "batteries.hpp"
#include "doors.hpp"
#include "items.hpp"
#include "motion/physics.hpp"
#include "movers.hpp"
#include "orca/base/team.hpp"
#include "orca/geometry/arc.hpp"
#include "orca/sim/sections.hpp"
#include "orca/sim/stand.hpp"
#include "robot.hpp"
#include "robot_solids.hpp"
#include "schedule.hpp"

namespace orca::sim {
namespace {

using detail::text;

constexpr double kFarthest = 1e5;  // [m]
constexpr double kFastest = 1e3;   // [m/s], [rad/s]

std::size_t index(RobotId id) { return static_cast<std::size_t>(id); }

bool is_near(const Pose2& pose) {
  return std::fabs(pose.x) <= kFarthest && std::fabs(pose.y) <= kFarthest && std::isfinite(pose.yaw);
}

// Returns true if the shape lies within the largest world that can be simulated.
bool is_near(const Shape& shape) {
  const auto near = [](Vec2 p) { return std::fabs(p.x) <= kFarthest && std::fabs(p.y) <= kFarthest; };
  if (const auto* circle = std::get_if<Circle>(&shape))
    return near(circle->center) && std::fabs(circle->radius) <= kFarthest;
  return std::ranges::all_of(edges_of(shape), [&](const Segment& s) { return near(s.a) && near(s.b); });
}

// Returns true if the shape has an area, as the plan of a solid must have.
bool has_area(const Shape& shape) {
  if (const auto* circle = std::get_if<Circle>(&shape)) return circle->radius > 0.0;
  if (const auto* box = std::get_if<Box>(&shape)) return box->half.x > 0.0 && box->half.y > 0.0;
  const Bounds b = bounds_of(shape);
  return b.low.x < b.high.x && b.low.y < b.high.y;
}

}  // namespace

struct World::Impl {
  Impl(WorldModel m, Options o)
      : model(std::move(m)),
        options(o),
        errors(o.errors.value_or(error_levels(o.realism))),
        caster(model),
        physics(model, errors),
        movers(model, o.seed, caster, physics),
        schedule(model.events, o.seed),
        doors(model, o.seed),
        team(o.threads) {}

  WorldModel model;
  Options options;
  ErrorLevels errors;
  Caster caster;
  detail::Physics physics;
  detail::ContactLog contact_log;
  detail::Movers movers;
  detail::Schedule schedule;
  detail::Doors doors;
  std::deque<detail::Robot> robots;  // Robots do not move in memory. Their numbers are those in physics.
  detail::Items items{model, robots, movers};
  detail::Batteries batteries{model, robots};
  std::vector<std::size_t> bodies;        // The robots' numbers in the caster.
  std::vector<detail::RobotSolids> seen;  // What sensors see of the robots.
  std::set<double> eyes;                  // [m] Heights of all sensors of ranges.
  detail::SonarAir air;
  Team team;  // Each robot senses for itself.
  std::vector<ContactEvent> contacts;
  std::vector<std::string> notes;  // Of what happened in the last tick.
  TimePoint now{};

  [[nodiscard]] detail::Robot& robot(RobotId id) { return robots.at(index(id)); }
  [[nodiscard]] const detail::Robot& robot(RobotId id) const { return robots.at(index(id)); }
  [[nodiscard]] Status check_birth(const std::string& name, const RobotModel& model, const Pose2& X_WB) const;
  [[nodiscard]] Status check_stand(const std::string& name, const RobotModel& model, const Pose2& X_WB) const;
  [[nodiscard]] Status check_room(const std::string& name, const Body& body, const Pose2& X_WO) const;
  [[nodiscard]] const std::string& name_of(const detail::Pair& pair) const;
  void show(const detail::Robot& robot);
  void drive();
  void report_contacts();
  void move();
  void sense();
  // Returns whether the mover of that number was added while the world ran.
  [[nodiscard]] bool is_obstacle(std::size_t number) const {
    return movers.is_obstacle(number) && !items.is_mover(number);
  }
  // Returns what a sensor has read, nothing while it is out.
  template <class Reading>
  [[nodiscard]] const std::optional<Reading>& unless_out(RobotId id, SensorKind sensor,
                                                         std::string_view device,
                                                         const std::optional<Reading>& reading) const {
    static const std::optional<Reading> nothing;
    return schedule.is_out(robot(id).name, sensor, device, now) ? nothing : reading;
  }
};

Status World::Impl::check_birth(const std::string& name, const RobotModel& robot_model,
                                const Pose2& X_WB) const {
  if (name.empty()) return fail(Code::invalid_argument, "a robot needs a name");
  if (std::ranges::find(robots, name, &detail::Robot::name) != robots.end())
    return fail(Code::already_exists, "there is a robot '" + name + "' already; choose another name");
  return check_stand(name, robot_model, X_WB);
}

Status World::Impl::check_stand(const std::string& name, const RobotModel& robot_model,
                                const Pose2& X_WB) const {
  const std::string who = "robot '" + name + "'";
  if (!is_near(X_WB)) return fail(Code::invalid_argument, who + ": its pose is not finite or beyond 100 km");
  const std::string there = who + " cannot stand at " + text(X_WB) + ": it would stand in ";
  const std::string remedy = "; choose a free place";
  for (const detail::Robot& other : robots)
    if (other.name != name && stand_in_each_other(robot_model, X_WB, other.model, other.body, Extent::solid))
      return fail(Code::failed_precondition, there + "robot '" + other.name + "'" + remedy);
  if (const std::optional<std::string> o = obstacle_in(robot_model, X_WB, model))
    return fail(Code::failed_precondition,
                there + "obstacle '" + *o + "' of world '" + model.name + "'" + remedy);
  for (const Part& part : robot_model.parts) {
    const auto [bottom, top] = height_range_of(part);
    for (const Shape& plan : plans_between({part}, bottom, top))
      if (const std::string* mover = movers.at(placed(plan, X_WB), bottom))
        return fail(Code::failed_precondition, there + "'" + *mover + "'" + remedy);
  }
  return ok();
}

Status World::Impl::check_room(const std::string& name, const Body& body, const Pose2& X_WO) const {
  const std::string who = "obstacle '" + name + "'";
  if (!is_near(X_WO) || !is_near(body.shape))
    return fail(Code::invalid_argument, who + ": its pose or shape is not finite or beyond 100 km");
  if (const detail::Robot* const robot = detail::robot_at(robots, body))
    return fail(Code::failed_precondition, who + " cannot stand at " + text(X_WO) + ": robot '" +
                                               robot->name + "' is there; choose a free place");
  return ok();
}

// Lets sensors see a new robot. If it brings sensors at new heights, all robots are cut there, too.
void World::Impl::show(const detail::Robot& robot) {
  const std::size_t before = eyes.size();
  eyes.merge(detail::sensor_heights(robot.model));
  if (eyes.size() != before)
    for (std::size_t i = 0; i < seen.size(); ++i) {
      seen[i] = detail::RobotSolids(robots[i].model, eyes);
      caster.move_solids(bodies[i], seen[i].at(robots[i].body));
    }
  seen.emplace_back(robot.model, eyes);
  bodies.push_back(caster.add_solids(seen.back().at(robot.body)));
}

// Bodies move straight in a tick; driving along the chord of the arc makes the result exact.
void World::Impl::drive() {
  const double seconds = to_seconds(kTick);
  for (std::size_t i = 0; i < robots.size(); ++i) {
    detail::Robot& r = robots[i];
    const Travel2 way = r.set_off(model.floor);
    physics.drive(i, {.velocity = (1.0 / seconds) * chord(r.pose.yaw, way),
                      .turn = r.body_turn(way) / seconds,
                      .heading = r.pose.yaw + 0.5 * way.turn,
                      .grip = model.floor.grip_at(r.body.position())});
  }
  movers.set_off(kTick, robots);
  physics.step(seconds);
  movers.arrive();
  now += kTick;
}

const std::string& World::Impl::name_of(const detail::Pair& pair) const {
  if (pair.kind == detail::Kind::robot) return robots[pair.other].name;
  return pair.kind == detail::Kind::mover ? movers.name(pair.other) : model.obstacles[pair.other].name;
}

void World::Impl::report_contacts() {
  contacts.clear();
  for (const detail::Pair& p : contact_log.update(physics)) {
    const detail::Robot& r = robots[p.robot];
    if (r.model.fixed) continue;  // What has driven into it says so.
    if (p.kind != detail::Kind::robot && p.kind != detail::Kind::mover && batteries.docks(r)) continue;
    contacts.push_back({r.name, now, name_of(p), r.speed(),
                        p.kind == detail::Kind::mover ? movers.walking_speed(p.other) : std::nullopt});
  }
}

void World::Impl::move() {
  for (std::size_t i = 0; i < robots.size(); ++i) {
    detail::Robot& r = robots[i];
    r.moved(physics.pose(i), now, contact_log.touches(i));
    caster.move_solids(bodies[i], seen[i].at(r.body));
  }
}

void World::Impl::sense() {
  air.settle(now - kTick);
  team.for_all(robots.size(),
               [this](std::size_t i) { robots[i].sensors.fire(caster, bodies[i], robots[i].carriers); });
  for (detail::Robot& robot : robots) robot.sensors.send(air);
  team.for_all(robots.size(), [this](std::size_t i) {
    detail::RobotSensors& sensors = robots[i].sensors;
    sensors.sense(caster, air, bodies[i], robots[i].carriers);
    if (!sensors.bumpers.empty()) sensors.feel(physics.touches(i), robots[i].carriers.body);
  });
}

World::World(WorldModel model, Options options) : impl_(std::make_unique<Impl>(std::move(model), options)) {}
World::~World() = default;
World::World(World&&) noexcept = default;
World& World::operator=(World&&) noexcept = default;

Result<RobotId> World::add_robot(const std::string& name, const RobotModel& model, const Pose2& X_WB) {
  if (const Status s = impl_->check_birth(name, model, X_WB); !s) return s.error();
  impl_->robots.emplace_back(detail::Robot::Birth{name, X_WB, impl_->now, impl_->options.seed, kTick}, model,
                             impl_->errors);
  impl_->show(impl_->robots.back());
  impl_->batteries.add();
  return RobotId{impl_->physics.add_robot(model, X_WB)};
}

Result<ObstacleId> World::add_obstacle(const std::string& name, const Shape& shape, double height,
                                       const Pose2& X_WO) {
  if (name.empty()) return fail(Code::invalid_argument, "an obstacle needs a name");
  if (impl_->movers.has_name(name) || impl_->items.pose(name))
    return fail(Code::already_exists, "there is a '" + name + "' already; choose another name");
  const std::string who = "obstacle '" + name + "'";
  if (!(height > 0.0 && height <= kFarthest))
    return fail(Code::invalid_argument, who + ": its height must be more than 0 m and at most 100 km");
  if (!has_area(shape)) return fail(Code::invalid_argument, who + ": its shape has no area");
  if (const Status s = impl_->check_room(name, {placed(shape, X_WO), 0.0, height}, X_WO); !s)
    return s.error();
  return ObstacleId{impl_->movers.add(name, shape, height, X_WO)};
}

Status World::move_obstacle(ObstacleId obstacle, const Pose2& X_WO) {
  const auto number = static_cast<std::size_t>(obstacle);
  detail::Movers& movers = impl_->movers;
  if (!impl_->is_obstacle(number)) return fail(Code::not_found, "there is no such obstacle in the world");
  if (const Status s = impl_->check_room(movers.name(number), movers.body_at(number, X_WO), X_WO); !s)
    return s;
  movers.move(number, X_WO);
  return ok();
}

Status World::remove_obstacle(ObstacleId obstacle) {
  const auto number = static_cast<std::size_t>(obstacle);
  if (!impl_->is_obstacle(number)) return fail(Code::not_found, "there is no such obstacle in the world");
  impl_->movers.remove(number);
  return ok();
}

Status World::place_robot(RobotId robot, const Pose2& X_WB) {
  detail::Robot& moved = impl_->robot(robot);
  if (const Status s = impl_->check_stand(moved.name, moved.model, X_WB); !s) return s;
  impl_->physics.place_robot(index(robot), X_WB);
  moved.put(X_WB, impl_->now);
  impl_->caster.move_solids(impl_->bodies[index(robot)], impl_->seen[index(robot)].at(moved.body));
  return ok();
}

std::optional<RobotId> World::find(std::string_view name) const {
  const auto found = std::ranges::find(impl_->robots, name, &detail::Robot::name);
  if (found == impl_->robots.end()) return std::nullopt;
  return RobotId{static_cast<std::size_t>(found - impl_->robots.begin())};
}

Status World::set_velocity_command(RobotId robot, double forward, double turn_rate) {
  return set_velocity_command(robot, Twist2{.forward = forward, .turn_rate = turn_rate});
}

Status World::set_velocity_command(RobotId robot, const Twist2& wanted) {
  detail::Robot& r = impl_->robot(robot);
  if (!is_finite(wanted)) return fail(Code::invalid_argument, "a velocity command must be finite", r.name);
  if (std::max({std::fabs(wanted.forward), std::fabs(wanted.left), std::fabs(wanted.turn_rate)}) > kFastest)
    return fail(
        Code::invalid_argument,
        "a velocity command beyond 1000 m/s or 1000 rad/s is no speed of a robot; what sends it is wrong",
        r.name);
  if (wanted.left != 0.0 && r.model.drive.kind != DriveKind::holonomic)
    return fail(Code::failed_precondition, "this base cannot move sideways; only a holonomic one can",
                r.name);
  if (r.model.fixed) return fail(Code::failed_precondition, "it has no drive", r.name);
  r.drive.command(wanted);
  return ok();
}

void World::emergency_stop(RobotId robot) { impl_->robot(robot).drive.emergency_stop(); }

Status World::set_turret_command(RobotId robot, double angle) {
  detail::Robot& r = impl_->robot(robot);
  if (!r.model.turret) return fail(Code::failed_precondition, "this robot has no turret", r.name);
  if (!std::isfinite(angle)) return fail(Code::invalid_argument, "a turret's angle must be finite", r.name);
  r.drive.point_turret(angle);
  return ok();
}

Status World::set_gripper_command(RobotId robot, const GripperOrder& order) {
  detail::Robot& r = impl_->robot(robot);
  if (!r.gripper) return fail(Code::failed_precondition, "this robot has no gripper", r.name);
  r.gripper->order(order);
  return ok();
}

// Grippers move after the bodies, so that what they let go stands where the robot has come to. They move before anything
// senses, so that a reading and the gripper's state of the same tick show the same floor. Robots touch what was let go from
// the next tick on.
void World::step() {
  impl_->notes.clear();
  impl_->schedule.run(*this, impl_->notes);
  impl_->doors.work(*this, impl_->notes);
  impl_->drive();
  impl_->report_contacts();
  impl_->move();
  impl_->items.handle(kTick, impl_->notes);
  impl_->batteries.work(kTick);
  impl_->sense();
}

TimePoint World::time() const { return impl_->now; }
Pose2 World::pose(RobotId robot) const { return impl_->robot(robot).pose; }
Pose2 World::body_pose(RobotId robot) const { return impl_->robot(robot).body; }
std::optional<TurretReading> World::turret(RobotId robot) const { return impl_->robot(robot).turret(); }
std::optional<GripperReading> World::gripper(RobotId robot) const {
  if (!impl_->robot(robot).gripper) return std::nullopt;
  return impl_->items.reading(index(robot), impl_->now);
}
std::optional<Pose2> World::item_pose(std::string_view name) const { return impl_->items.pose(name); }
Twist2 World::velocity(RobotId robot) const { return impl_->robot(robot).velocity; }
double World::clearance(RobotId robot, double limit) const {
  return impl_->physics.clearance(index(robot), limit);
}
const std::vector<ContactEvent>& World::contacts() const { return impl_->contacts; }
const std::vector<std::string>& World::happened() const { return impl_->notes; }
const std::optional<SonarScan>& World::sonar(RobotId robot, std::size_t ring) const {
  const auto& body = impl_->robot(robot);
  return impl_->unless_out(robot, SensorKind::sonar, body.model.sonars.at(ring).name,
                           body.sensors.sonars.at(ring).completed());
}
const std::optional<LaserScan>& World::laser(RobotId robot, std::size_t laser) const {
  const auto& body = impl_->robot(robot);
  return impl_->unless_out(robot, SensorKind::laser, body.model.lasers.at(laser).name,
                           body.sensors.lasers.at(laser).completed());
}
const std::optional<InfraredScan>& World::infrared(RobotId robot, std::size_t ring) const {
  const auto& body = impl_->robot(robot);
  return impl_->unless_out(robot, SensorKind::infrared, body.model.infrareds.at(ring).name,
                           body.sensors.infrareds.at(ring).completed());
}
const std::optional<BumperReading>& World::bumper(RobotId robot, std::size_t ring) const {
  const auto& body = impl_->robot(robot);
  return impl_->unless_out(robot, SensorKind::bumper, body.model.bumpers.at(ring).name,
                           body.sensors.bumpers.at(ring).completed());
}
const std::optional<OdometryReading>& World::odometry(RobotId robot) const {
  return impl_->unless_out(robot, SensorKind::odometry, "odometry", impl_->robot(robot).odometry);
}
const WorldModel& World::model() const { return impl_->model; }
const RobotModel& World::robot_model(RobotId robot) const { return impl_->robot(robot).model; }
const Caster& World::caster() const { return impl_->caster; }
std::size_t World::body(RobotId robot) const { return impl_->bodies.at(index(robot)); }

void World::keep_trajectory(RobotId robot) { impl_->robot(robot).keep_trail(); }

Snapshot World::snapshot() const {
  Snapshot snapshot = snapshot_of(impl_->model);
  impl_->movers.draw(snapshot);
  impl_->items.draw(snapshot);
  for (const detail::Robot& r : impl_->robots) snapshot.robots.push_back(r.drawn());
  return snapshot;
}

std::vector<Person> people_in(const World& world) { return world.impl_->movers.people(); }

std::vector<std::string> robots_in(const World& world) {
  std::vector<std::string> names;
  for (const detail::Robot& robot : world.impl_->robots) names.push_back(robot.name);
  return names;
}

std::vector<Standing> standing_in(const World& world) {
  const World::Impl& impl = *world.impl_;
  std::vector<Standing> all;
  for (std::size_t number = 0; number < impl.movers.size(); ++number)
    if (impl.is_obstacle(number)) all.push_back(impl.movers.obstacle(number));
  for (const Item& item : impl.model.items)
    all.push_back({item.name, Circle{{}, item.radius}, impl.items.pose(item.name).value_or(item.pose)});
  return all;
}

std::vector<DoorState> doors_in(const World& world) { return world.impl_->doors.states(); }

Status turn_door(World& world, std::string_view name, bool opens) {
  return world.impl_->doors.turn(world, name, opens);
}

const std::optional<CameraShot>& picture_in(const World& world, RobotId robot, std::size_t camera) {
  const detail::Robot& body = world.impl_->robot(robot);
  return world.impl_->unless_out(robot, SensorKind::camera, body.model.cameras.at(camera).name,
                                 body.sensors.cameras.at(camera).completed());
}

std::optional<BatteryReading> battery_in(const World& world, RobotId robot) {
  const detail::BatteryModel* const battery = std::as_const(world.impl_->batteries).of(index(robot));
  return battery == nullptr ? std::nullopt : std::optional(battery->reading(world.impl_->now));
}

Status set_charge(World& world, RobotId robot, double charge) {
  detail::BatteryModel* const battery = world.impl_->batteries.of(index(robot));
  if (battery == nullptr)
    return fail(Code::not_found, "this robot has no battery", world.impl_->robot(robot).name);
  battery->set_charge(charge);
  return ok();
}

Status set_silent(World& world, const Outage& which, bool silent) {
  World::Impl& impl = *world.impl_;
  const auto robot = world.find(which.robot);
  if (!robot) return fail(Code::not_found, "there is no robot '" + which.robot + "' in the world");
  if (!detail::has(world.robot_model(*robot), which))
    return fail(Code::not_found, which.robot + " has no " +
                                     std::string(kSensorKinds.at(static_cast<std::size_t>(which.sensor))) +
                                     (which.device.empty() ? "" : " '" + which.device + "'"));
  return silent ? impl.schedule.silence(which, impl.now) : impl.schedule.restore(which, impl.now);
}

std::vector<std::string> silent_in(const World& world, RobotId robot) {
  return world.impl_->schedule.silent(world.impl_->robot(robot).name, world.impl_->now);
}

std::uint64_t World::state_hash() const {
  Fnv1a hash;
  hash.add_u64(static_cast<std::uint64_t>(impl_->now.time_since_epoch().count()));
  for (const detail::Robot& r : impl_->robots) r.add_to(hash);
  impl_->movers.add_to(hash);
  impl_->items.add_to(hash);
  impl_->batteries.add_to(hash);
  return hash.value();
}

}  // namespace orca::sim
