// SPDX-License-Identifier: LGPL-3.0-or-later
#include "world_objects.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"

namespace orca::sim {
namespace {

constexpr double kUsualHeight = 1.0;  // [m]

idl::WorldEdge to_object(const Segment& edge) {
  idl::WorldEdge object;
  object.a().x(edge.a.x);
  object.a().y(edge.a.y);
  object.b().x(edge.b.x);
  object.b().y(edge.b.y);
  return object;
}

std::vector<idl::WorldEdge> to_objects(const std::vector<Segment>& edges) {
  std::vector<idl::WorldEdge> objects;
  for (const Segment& edge : edges) objects.push_back(to_object(edge));
  return objects;
}

void add_circle(const Circle& circle, std::vector<idl::WorldEdge>& walls) {
  constexpr int kSides = 16;
  const auto corner = [&](int i) {
    return circle.center + circle.radius * direction(2.0 * std::numbers::pi * i / kSides);
  };
  for (int i = 0; i < kSides; ++i) walls.push_back(to_object({corner(i), corner(i + 1)}));
}

template <class Object>
void put_at(const Pose2& pose, Object& object) {
  object.x(pose.x);
  object.y(pose.y);
  object.yaw(pose.yaw);
}

idl::WorldRobot robot_of(const World& world, RobotId id, const std::string& name) {
  const RobotModel& model = world.robot_model(id);
  const Twist2 velocity = world.velocity(id);
  idl::WorldRobot robot;
  robot.name(name);
  put_at(world.body_pose(id), robot);
  robot.forward(velocity.forward);
  robot.left(velocity.left);
  robot.turn_rate(velocity.turn_rate);
  robot.radius(model.radius);
  robot.outline(to_objects(edges_of(model.footprint)));
  robot.silent(silent_in(world, id));
  return robot;
}

idl::WorldPerson to_object(const Person& person) {
  idl::WorldPerson object;
  object.name(person.name);
  object.x(person.position.x);
  object.y(person.position.y);
  object.radius(person.radius);
  object.speed(person.speed);
  return object;
}

// A circle's centre need not be the origin of its own frame.
idl::WorldObstacle to_object(const Standing& thing, bool is_leaf) {
  idl::WorldObstacle object;
  object.name(thing.name);
  put_at(thing.X_WO, object);
  if (const auto* const circle = std::get_if<Circle>(&thing.shape)) {
    object.radius(circle->radius);
    const Vec2 center = std::get<Circle>(placed(thing.shape, thing.X_WO)).center;
    object.x(center.x);
    object.y(center.y);
  } else {
    object.outline(to_objects(edges_of(thing.shape)));
  }
  object.movable(thing.id && !is_leaf);
  return object;
}

idl::WorldDoor to_object(const DoorState& door) {
  idl::WorldDoor object;
  object.name(door.name);
  object.leaf(to_object(door.leaf));
  object.open(door.opens);
  return object;
}

bool has_door(const std::vector<DoorState>& doors, const std::string& name) {
  return std::ranges::find(doors, name, &DoorState::name) != doors.end();
}

// --- Changes ----------------------------------------------------------------------------------------------

std::string at(const idl::WorldChange& change) {
  const auto number = [](double metres) { return xml::number_text(std::round(100.0 * metres) / 100.0); };
  return "(" + number(change.x()) + ", " + number(change.y()) + ") m";
}

Pose2 pose_of(const idl::WorldChange& change) { return {change.x(), change.y(), change.yaw()}; }

Shape shape_of(const idl::WorldChange& change) {
  if (change.width() == 0.0) return Circle{{}, 0.5 * change.length()};
  return Box{{}, {0.5 * change.length(), 0.5 * change.width()}};
}

Result<std::string> with(Status done, std::string text) {
  if (!done.ok()) return done.error();
  return text;
}

Error no_such(const char* kind, const std::string& name, const std::vector<std::string>& names) {
  return fail(Code::not_found, "there is no " + std::string(kind) + " " + in_quotes(name) + "; there are: " +
                                   listed(names) + xml::did_you_mean(xml::nearest_name(name, names)));
}

Result<ObstacleId> obstacle(const World& world, const std::string& name) {
  const std::vector<DoorState> doors = doors_in(world);
  std::vector<std::string> names;
  for (const Standing& thing : standing_in(world)) {
    if (thing.name == name && !thing.id)
      return fail(Code::failed_precondition, in_quotes(name) + " is for grippers: only a robot moves it");
    const bool is_leaf = has_door(doors, thing.name);
    if (thing.name == name && is_leaf)
      return fail(Code::failed_precondition, in_quotes(name) + " is a door: it is only opened and shut");
    if (thing.name == name) return *thing.id;
    if (thing.id && !is_leaf) names.push_back(thing.name);
  }
  for (const Obstacle& fast : world.model().obstacles)
    if (fast.name == name)
      return fail(Code::failed_precondition,
                  in_quotes(name) + " stands fast: it belongs to the plan of world " +
                      in_quotes(world.model().name) + ", and only what came to it moves and goes");
  return no_such("obstacle", name, names);
}

Result<std::string> put(const idl::WorldChange& change, World& world) {
  const double height = change.height() == 0.0 ? kUsualHeight : change.height();
  const Result<ObstacleId> put = world.add_obstacle(change.name(), shape_of(change), height, pose_of(change));
  if (!put) return put.error();
  return change.name() + " comes to " + at(change);
}

Result<std::string> move(const idl::WorldChange& change, World& world) {
  const Result<ObstacleId> moved = obstacle(world, change.name());
  if (!moved) return moved.error();
  return with(world.move_obstacle(*moved, pose_of(change)), change.name() + " is moved to " + at(change));
}

Result<std::string> take(const idl::WorldChange& change, World& world) {
  const Result<ObstacleId> taken = obstacle(world, change.name());
  if (!taken) return taken.error();
  return with(world.remove_obstacle(*taken), change.name() + " goes");
}

Result<std::string> carry(const idl::WorldChange& change, World& world) {
  const auto robot = world.find(change.name());
  if (!robot) return no_such("robot", change.name(), robots_in(world));
  if (world.robot_model(*robot).fixed)
    return fail(Code::failed_precondition, in_quotes(change.name()) + " is fixed where it stands");
  return with(world.place_robot(*robot, pose_of(change)), change.name() + " is carried to " + at(change));
}

Result<std::string> silence(const idl::WorldChange& change, World& world, bool silent) {
  const auto kind = std::ranges::find(kSensorKinds, change.sensor());
  if (kind == kSensorKinds.end())
    return fail(Code::invalid_argument,
                in_quotes(change.sensor()) + " is no kind of sensor; kinds: " +
                    listed(std::vector<std::string>(kSensorKinds.begin(), kSensorKinds.end())));
  const Outage which{.robot = change.name(),
                     .sensor = static_cast<SensorKind>(kind - kSensorKinds.begin()),
                     .device = change.device()};
  const std::string who = change.sensor() +
                          (change.device().empty() ? "" : " " + in_quotes(change.device())) + " of " +
                          change.name();
  return with(set_silent(world, which, silent), who + (silent ? " fails" : " works again"));
}

Result<std::string> turn(const idl::WorldChange& change, World& world, bool opens) {
  const std::vector<DoorState> doors = doors_in(world);
  std::vector<std::string> names;
  for (const DoorState& door : doors) names.push_back(door.name);
  if (!has_door(doors, change.name())) return no_such("door", change.name(), names);
  return with(turn_door(world, change.name(), opens), change.name() + (opens ? " opens" : " shuts"));
}

}  // namespace

void fill(idl::WorldPlan& plan, const WorldModel& model) {
  const Snapshot fast = snapshot_of(model);
  plan.name(model.name);
  plan.walls(to_objects(fast.edges));
  for (const Circle& circle : fast.circles) add_circle(circle, plan.walls());
  plan.places().clear();
  for (const Place& place : fast.places) {
    plan.places().emplace_back().name(place.name);
    put_at(place.pose, plan.places().back());
  }
}

void fill(idl::WorldScene& scene, const World& world) {
  scene.robots().clear();
  for (const std::string& name : robots_in(world))
    scene.robots().push_back(robot_of(world, *world.find(name), name));
  scene.people().clear();
  for (const Person& person : people_in(world)) scene.people().push_back(to_object(person));
  scene.obstacles().clear();
  const std::vector<DoorState> doors = doors_in(world);
  for (const Standing& thing : standing_in(world))
    scene.obstacles().push_back(to_object(thing, has_door(doors, thing.name)));
  scene.doors().clear();
  for (const DoorState& door : doors) scene.doors().push_back(to_object(door));
}

Result<std::string> carry_out(const idl::WorldChange& change, World& world) {
  switch (change.kind()) {
    case idl::PUT_OBSTACLE: return put(change, world);
    case idl::MOVE_OBSTACLE: return move(change, world);
    case idl::TAKE_OBSTACLE: return take(change, world);
    case idl::CARRY_ROBOT: return carry(change, world);
    case idl::SILENCE_SENSOR: return silence(change, world, true);
    case idl::RESTORE_SENSOR: return silence(change, world, false);
    case idl::OPEN_DOOR: return turn(change, world, true);
    case idl::SHUT_DOOR: return turn(change, world, false);
  }
  return fail(Code::invalid_argument,
              "no kind of change has the number " + std::to_string(static_cast<unsigned>(change.kind())));
}

}  // namespace orca::sim
