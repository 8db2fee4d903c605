// SPDX-License-Identifier: LGPL-3.0-or-later
#include "schedule.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

namespace orca::sim::detail {
namespace {

Result<RobotId> robot_of(const World& world, const std::string& name) {
  if (const auto robot = world.find(name)) return *robot;
  return fail(Code::not_found, "there is no robot \"" + name + "\" in the world");
}

std::string name_of(SensorKind kind) { return std::string(kSensorKinds.at(static_cast<std::size_t>(kind))); }

// Whether one of the devices has that name; empty: whether there are any.
template <class Device>
bool holds(const std::vector<Device>& devices, const std::string& name) {
  return name.empty() ? !devices.empty() : std::ranges::find(devices, name, &Device::name) != devices.end();
}

// Returns the circle in which a robot turns round, with some room.
Circle turning_circle(const RobotModel& robot, Vec2 at) {
  constexpr double kBeside = 0.1;  // [m]
  double radius = 0.0;
  if (const auto* round = std::get_if<Circle>(&robot.footprint)) radius = norm(round->center) + round->radius;
  for (const Segment& edge : edges_of(robot.footprint)) radius = std::max(radius, norm(edge.a));
  return {at, radius + kBeside};
}

// Returns whether a robot could turn round at a place, were it not for what moves.
bool has_room(const World& world, const RobotModel& robot, Vec2 at) {
  return world.model().obstacle_at(turning_circle(robot, at), robot.bottom, robot.top) == nullptr;
}

// Puts a robot at a drawn place. Each step draws a line through the last place, and a place on the free part of that line. After many steps
// each place to which there is a way is as likely as any other (hit-and-run: Smith, Operations Research 32(6), 1984).
Status carry_off(World& world, RobotId robot, double away, RandomStream& random) {
  constexpr int kLines = 300;  // for about ten rooms
  constexpr int kMost = 100 * kLines;
  constexpr double kLongest = 100.0;  // [m]
  const RobotModel& model = world.robot_model(robot);
  const Vec2 from = world.pose(robot).position();
  Vec2 at = from;
  for (int i = 1; i <= kMost; ++i) {
    const double yaw = random.uniform(-std::numbers::pi, std::numbers::pi);
    const auto free = [&](Vec2 way) {
      return world.caster().cast({at, way, kLongest, model.bottom, world.body(robot)}).range;
    };
    const Vec2 ahead = direction(yaw);
    at = at + random.uniform(-free(-1.0 * ahead), free(ahead)) * ahead;
    if (i % kLines != 0 || norm(at - from) < away || !has_room(world, model, at)) continue;
    if (world.place_robot(robot, {at.x, at.y, yaw}).ok()) return ok();
  }
  return fail(Code::not_found, "no free place was found that is far enough away");
}

}  // namespace

bool has(const RobotModel& model, const Outage& outage) {
  switch (outage.sensor) {
    case SensorKind::sonar: return holds(model.sonars, outage.device);
    case SensorKind::laser: return holds(model.lasers, outage.device);
    case SensorKind::infrared: return holds(model.infrareds, outage.device);
    case SensorKind::bumper: return holds(model.bumpers, outage.device);
    case SensorKind::camera: return holds(model.cameras, outage.device);
    case SensorKind::odometry: return model.odometer && outage.device.empty();
  }
  return false;
}

Schedule::Schedule(const Events& events, std::uint64_t seed) : outages_(events.outages) {
  for (const Visitor& visitor : events.visitors) add(visitor);
  for (const Move& move : events.moves) add(move);
  for (std::size_t i = 0; i < events.kidnaps.size(); ++i)
    add(events.kidnaps[i], RandomStream(seed, events.kidnaps[i].robot, "kidnap " + std::to_string(i)));
  for (const Outage& outage : events.outages) add(outage);
  for (const Drain& drain : events.drains) add(drain);
  std::ranges::stable_sort(steps_, {}, &Step::at);
}

void Schedule::add(const Visitor& visitor) {
  steps_.push_back({visitor.comes, visitor.name + " comes", [this, visitor](World& world) -> Status {
                      const Result<ObstacleId> added =
                          world.add_obstacle(visitor.name, visitor.shape, visitor.height, visitor.X_WO);
                      if (!added) return added.error();
                      there_[visitor.name] = *added;
                      return ok();
                    }});
  if (!visitor.goes) return;
  steps_.push_back({*visitor.goes, visitor.name + " goes", [this, name = visitor.name](World& world) {
                      return with(name, [&](ObstacleId id) { return world.remove_obstacle(id); });
                    }});
}

void Schedule::add(const Move& move) {
  steps_.push_back({move.at, move.visitor + " is moved", [this, move](World& world) {
                      return with(move.visitor,
                                  [&](ObstacleId id) { return world.move_obstacle(id, move.X_WO); });
                    }});
}

void Schedule::add(const Kidnap& kidnap, RandomStream random) {
  const Duration at = kidnap.latest
                          ? from_seconds(random.uniform(to_seconds(kidnap.at), to_seconds(*kidnap.latest)))
                          : kidnap.at;
  steps_.push_back({at, kidnap.robot + " is kidnapped", [kidnap, random](World& world) mutable -> Status {
                      const Result<RobotId> robot = robot_of(world, kidnap.robot);
                      if (!robot) return robot.error();
                      return kidnap.away ? carry_off(world, *robot, *kidnap.away, random)
                                         : world.place_robot(*robot, kidnap.X_WB);
                    }});
}

void Schedule::add(const Outage& outage) {
  const auto look = [outage](World& world) -> Status {
    const Result<RobotId> robot = robot_of(world, outage.robot);
    if (!robot) return robot.error();
    if (outage.device.empty() || has(world.robot_model(*robot), outage)) return ok();
    return fail(Code::not_found, outage.robot + " has no " + name_of(outage.sensor) + " of that name");
  };
  const std::string which = outage.device.empty() ? "" : " \"" + outage.device + "\"";
  const std::string who = name_of(outage.sensor) + which + " of " + outage.robot;
  steps_.push_back({outage.from, who + " fails", look});
  if (outage.until) steps_.push_back({*outage.until, who + " works again", look});
}

void Schedule::add(const Drain& drain) {
  steps_.push_back({drain.at, "the battery of " + drain.robot + " changes", [drain](World& world) -> Status {
                      const Result<RobotId> robot = robot_of(world, drain.robot);
                      return robot ? set_charge(world, *robot, drain.to) : Status(robot.error());
                    }});
}

// A visitor that has not come yet has a robot in its way.
Status Schedule::with(const std::string& visitor, const std::function<Status(ObstacleId)>& act) const {
  const auto found = there_.find(visitor);
  if (found == there_.end()) return fail(Code::failed_precondition, visitor + " has not come yet");
  return act(found->second);
}

void Schedule::run(World& world, std::vector<std::string>& notes) {
  const Duration now = world.time() - TimePoint{};
  const auto first_future = std::ranges::upper_bound(steps_, now, {}, &Step::at);
  const auto undone =
      std::remove_if(steps_.begin(), first_future, [&](Step& step) { return take(step, world, notes); });
  steps_.erase(undone, first_future);
}

bool Schedule::take(Step& step, World& world, std::vector<std::string>& notes) {
  const Status done = step.act(world);
  const bool waits = !done && done.error().code == Code::failed_precondition;
  if (done) notes.push_back(step.text);
  if (!done && !step.waits)
    notes.push_back(step.text + (waits ? " later: " : " not at all: ") + done.error().message);
  step.waits = waits;
  return !waits;
}

namespace {

bool holds_at(const Outage& one, Duration time) {
  return one.from <= time && (!one.until || time < *one.until);
}

std::string text_of(const Outage& one) {
  return name_of(one.sensor) + (one.device.empty() ? "" : " " + one.device);
}

}  // namespace

bool Schedule::is_out(std::string_view robot, SensorKind sensor, std::string_view device,
                      TimePoint now) const {
  const Duration time = now - TimePoint{};
  return std::ranges::any_of(outages_, [&](const Outage& one) {
    const bool is_meant =
        one.sensor == sensor && one.robot == robot && (one.device.empty() || one.device == device);
    return is_meant && holds_at(one, time);
  });
}

Status Schedule::silence(Outage which, TimePoint now) {
  if (is_out(which.robot, which.sensor, which.device, now))
    return fail(Code::failed_precondition, text_of(which) + " of " + which.robot + " is silent already");
  which.from = now - TimePoint{};
  which.until.reset();
  outages_.push_back(std::move(which));
  return ok();
}

Status Schedule::restore(const Outage& which, TimePoint now) {
  const Duration time = now - TimePoint{};
  bool was_out = false;
  for (Outage& one : outages_) {
    const bool is_meant = one.robot == which.robot && one.sensor == which.sensor &&
                          (which.device.empty() || one.device == which.device);
    if (!is_meant || !holds_at(one, time)) continue;
    one.until = time;
    was_out = true;
  }
  if (is_out(which.robot, which.sensor, which.device, now))
    return fail(Code::failed_precondition, "every " + name_of(which.sensor) + " of " + which.robot +
                                               " is silent; restore them together, with no device");
  if (was_out) return ok();
  return fail(Code::failed_precondition, text_of(which) + " of " + which.robot + " is not silent");
}

std::vector<std::string> Schedule::silent(std::string_view robot, TimePoint now) const {
  std::vector<std::string> all;
  for (const Outage& one : outages_)
    if (one.robot == robot && holds_at(one, now - TimePoint{})) all.push_back(text_of(one));
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace orca::sim::detail
