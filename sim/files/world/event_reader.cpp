// SPDX-License-Identifier: LGPL-3.0-or-later
#include "event_reader.hpp"

#include <algorithm>
#include <utility>

#include "codes.hpp"
#include "orca/robot_file/values.hpp"

namespace orca::sim::detail {

using namespace robot_file::values;

namespace {

constexpr std::size_t kMostVisitors = 1000;

std::optional<Pose2> read_pose(const xml::Attributes& element) {
  const auto x = element.number("x");
  const auto y = element.number("y");
  const auto yaw = element.number_or("yaw", 0.0);
  if (!x || !y || !yaw) return std::nullopt;
  return Pose2{*x, *y, *yaw};
}

std::optional<SensorKind> read_sensor(const xml::Attributes& element) {
  const auto name = element.choice("sensor");
  if (!name) return std::nullopt;
  return static_cast<SensorKind>(std::ranges::find(kSensorKinds, *name) - kSensorKinds.begin());
}

// Reads the end of a time; reports one that does not lie behind its begin.
std::optional<Duration> read_end(const xml::Attributes& element, const char* attribute, Duration begin) {
  if (!element.has(attribute)) return std::nullopt;
  const auto end = element.duration(attribute);
  if (end && *end <= begin)
    element.error_at(attribute, world_codes::kBadEvent, "it must end after it has begun; give a later time");
  return end;
}

}  // namespace

bool EventReader::is_visitor(const xml::Attributes& element) {
  return element.has("comes") || element.has("goes");
}

void EventReader::visitor(const xml::Attributes& element, Shape shape, const Pose2& X_WO, double height) {
  if (!element.has("name"))
    element.error(world_codes::kBadEvent, "an obstacle that comes or goes needs the attribute \"name\"");
  if (element.has("bottom"))
    element.error_at("bottom", world_codes::kBadEvent,
                     "an obstacle that comes or goes stands on the floor; leave \"bottom\" out");
  Visitor visitor{element.name("name").value_or(""), std::move(shape), height, X_WO};
  set(visitor.comes, element.duration_or("comes", Duration{0}));
  visitor.goes = read_end(element, "goes", visitor.comes);
  events_.visitors.push_back(std::move(visitor));
  last_visitor_ = element.element().position();
}

void EventReader::move(const xml::Attributes& element) {
  const auto of = element.name("of");
  const auto at = element.duration("at");
  const auto pose = read_pose(element);
  if (!of || !at || !pose) return;
  events_.moves.push_back({*of, *at, *pose});
  move_positions_.push_back(element.element().position());
}

void EventReader::kidnap(const xml::Attributes& element) {
  const auto robot = element.text("robot");
  const auto at = element.duration("at");
  if (!robot || !at) return;
  const bool is_drawn = element.has("away");
  const bool has_place = element.has("x") && element.has("y");
  const bool has_some = element.has("x") || element.has("y") || element.has("yaw");
  if (is_drawn ? has_some : !has_place)
    return element.error(
        world_codes::kBadEvent,
        "give either x and y, where the robot is put, or away, how far from there a place is "
        "drawn at least");
  const auto pose = is_drawn ? Pose2{} : read_pose(element);
  const auto away = is_drawn ? element.number("away") : std::nullopt;
  if (!pose || is_drawn != away.has_value()) return;
  events_.kidnaps.push_back({*robot, *at, *pose, read_end(element, "latest", *at), away});
}

void EventReader::outage(const xml::Attributes& element) {
  const auto robot = element.text("robot");
  const auto sensor = read_sensor(element);
  const auto at = element.duration("at");
  if (!robot || !sensor || !at) return;
  events_.outages.push_back(
      {*robot, *sensor, *at, read_end(element, "until", *at), element.text("device").value_or("")});
}

void EventReader::drain(const xml::Attributes& element) {
  const auto robot = element.text("robot");
  const auto at = element.duration("at");
  const auto to = element.number("to");
  if (robot && at && to) events_.drains.push_back({*robot, *at, *to});
}

void EventReader::turn(const xml::Attributes& element, bool opens) {
  const auto door = element.name("of");
  const auto at = element.duration("at");
  if (!door || !at) return;
  events_.turns.push_back({*door, opens, *at, read_end(element, "latest", *at)});
  turn_positions_.push_back(element.element().position());
}

Events EventReader::take(const std::vector<Door>& doors) {
  if (events_.visitors.size() > kMostVisitors)
    reporter_.error(world_codes::kTooMany, last_visitor_,
                    "the world has " + std::to_string(events_.visitors.size()) +
                        " obstacles that come or go, at most " + std::to_string(kMostVisitors) + " are read");
  for (std::size_t i = 0; i < events_.moves.size(); ++i) check(events_.moves[i], move_positions_[i]);
  for (std::size_t i = 0; i < events_.turns.size(); ++i) check(events_.turns[i], doors, turn_positions_[i]);
  return std::move(events_);
}

void EventReader::check(const Move& move, const xml::Position& position) {
  const auto visitor = std::ranges::find(events_.visitors, move.visitor, &Visitor::name);
  if (visitor == events_.visitors.end()) {
    std::vector<std::string> names;
    for (const Visitor& one : events_.visitors) names.push_back(one.name);
    return reporter_.error(
        world_codes::kBadEvent, position,
        "there is no obstacle \"" + move.visitor +
            "\" that can be moved: it needs \"comes\", of 0 s if it is there from the start" +
            reporter_.hint(move.visitor, names));
  }
  if (move.at < visitor->comes || (visitor->goes && move.at >= *visitor->goes))
    reporter_.error(world_codes::kBadEvent, position, "\"" + move.visitor + "\" is not there at that time");
}

void EventReader::check(const DoorTurn& turn, const std::vector<Door>& doors, const xml::Position& position) {
  std::vector<std::string> names;
  for (const Door& door : doors) names.push_back(door.name);
  if (std::ranges::find(names, turn.door) == names.end())
    reporter_.error(world_codes::kBadDoor, position,
                    "there is no door \"" + turn.door + "\" that can be opened or shut" +
                        reporter_.hint(turn.door, names));
}

}  // namespace orca::sim::detail
