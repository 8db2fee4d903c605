// SPDX-License-Identifier: LGPL-3.0-or-later
#include "schedule.hpp"

#include <algorithm>

namespace orca::sim::detail {
namespace {

Result<RobotId> robot_of(const World& world, const std::string& name) {
  if (const auto robot = world.find(name)) return *robot;
  return fail(Code::not_found, "there is no robot \"" + name + "\" in the world");
}

std::string name_of(SensorKind kind) { return std::string(kSensorKinds.at(static_cast<std::size_t>(kind))); }

template <class Device>
bool holds(const std::vector<Device>& devices, const std::string& name) {
  return std::ranges::find(devices, name, &Device::name) != devices.end();
}

// Whether the robot has the device that is to fail.
bool has(const RobotModel& model, const Outage& outage) {
  if (outage.device.empty()) return true;
  switch (outage.sensor) {
    case SensorKind::sonar: return holds(model.sonars, outage.device);
    case SensorKind::laser: return holds(model.lasers, outage.device);
    case SensorKind::infrared: return holds(model.infrareds, outage.device);
    case SensorKind::bumper: return holds(model.bumpers, outage.device);
    case SensorKind::odometry: return false;
  }
  return false;
}

}  // namespace

Schedule::Schedule(const Events& events) : outages_(events.outages) {
  for (const Visitor& visitor : events.visitors) add(visitor);
  for (const Move& move : events.moves) add(move);
  for (const Kidnap& kidnap : events.kidnaps) add(kidnap);
  for (const Outage& outage : events.outages) add(outage);
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

void Schedule::add(const Kidnap& kidnap) {
  steps_.push_back({kidnap.at, kidnap.robot + " is kidnapped", [kidnap](World& world) -> Status {
                      const Result<RobotId> robot = robot_of(world, kidnap.robot);
                      return robot ? world.place_robot(*robot, kidnap.X_WB) : robot.error();
                    }});
}

void Schedule::add(const Outage& outage) {
  const auto look = [outage](World& world) -> Status {
    const Result<RobotId> robot = robot_of(world, outage.robot);
    if (!robot) return robot.error();
    if (has(world.robot_model(*robot), outage)) return ok();
    return fail(Code::not_found, outage.robot + " has no " + name_of(outage.sensor) + " of that name");
  };
  const std::string which = outage.device.empty() ? "" : " \"" + outage.device + "\"";
  const std::string who = name_of(outage.sensor) + which + " of " + outage.robot;
  steps_.push_back({outage.from, who + " fails", look});
  if (outage.until) steps_.push_back({*outage.until, who + " works again", look});
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

bool Schedule::is_out(std::string_view robot, SensorKind sensor, std::string_view device,
                      TimePoint now) const {
  const Duration time = now - TimePoint{};
  return std::ranges::any_of(outages_, [&](const Outage& one) {
    const bool is_meant =
        one.sensor == sensor && one.robot == robot && (one.device.empty() || one.device == device);
    return is_meant && one.from <= time && (!one.until || time < *one.until);
  });
}

}  // namespace orca::sim::detail
