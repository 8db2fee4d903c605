// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/component.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/geometry/objects/covariance.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/geometry/objects/waiting_scans.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/idl/ways.hpp"
#include "orca/navigation/beams.hpp"
#include "orca/navigation/pose_history.hpp"
#include "orca/planning/floor.hpp"
#include "orca/planning/ways.hpp"
#include "orca/planning/ways_file.hpp"

namespace {

using orca::ObjectPtr;
using orca::Pose2;
using orca::TimePoint;
using orca::Vec2;
using orca::idl::GoalPoint;
using orca::idl::OccupancyGrid;
using orca::idl::Route;
using orca::planning::FoundWay;
using orca::planning::WayPoint;
using orca::planning::Ways;

constexpr double kNoWay = std::numeric_limits<double>::infinity();

/// A door that is shut. Its end is when that is forgotten, unless it is seen open before.
struct ShutDoor {
  std::string name;
  TimePoint end{};

  auto state() { return std::tie(name, end); }
};

/// A leg that a robot could not drive.
struct Blockage {
  std::string from;  // its place; empty: wherever the robot was
  std::string to;    // its place; empty: a goal that is none
  Vec2 goal;         // that goal
  Vec2 robot;        // where the robot was
  TimePoint end{};   // when it is forgotten

  auto state() { return std::tie(from, to, goal, robot, end); }
};

/// A server of routes through a topological map (thesis 8.3: GoalPoint, Door). It sees which doors are shut, hears which legs are blocked, and
/// forgets that after a while. See README.md.
class RouteServer final : public orca::Component {
 public:
  explicit RouteServer(orca::ComponentHost& host) : Component(host) { lap_on("localizer"); }

 private:
  orca::Status configure() override {
    if (ways_file_->empty())
      return ways_file_.refuse("it is not set; name a topological map, e.g. \"../sim/ways/office.xml\"");
    orca::Result<Ways> ways = orca::planning::read_ways(*ways_file_);
    if (!ways) return ways_file_.refuse(ways.error().message);
    stay_active(true);  // It sees doors also while nobody drives by its routes.
    ways_ = std::move(*ways);
    return orca::ok();
  }

  void save_state(orca::StateWriter& state) const override { state.write(shut_, blocked_); }
  orca::Status load_state(orca::StateReader& state) override { return state.read(shut_, blocked_); }
  [[nodiscard]] std::uint32_t state_version() const override { return 2; }

  orca::Outcome work() override {
    const auto pose = localizer_.get_update();
    while (world_.new_data_arrived())
      if (const orca::Status taken = floor_.take(*world_.get_update()); !taken.ok())
        log_warning(taken.error().message);
    if (!senders_.accepts(*pose)) return orca::again();
    X_WR_ = orca::plane_pose(*pose);
    forget();
    knows_pose_ = !orca::is_anywhere(pose->covariance());
    if (!knows_pose_) {
      history_.clear();
      return orca::again();
    }
    history_.add(orca::to_time_point(pose->stamp()), X_WR_);
    if (laser_.connected()) look_at_doors();
    return orca::again();
  }

  void forget() {
    std::erase_if(blocked_, [this](const Blockage& one) { return one.end <= now(); });
    for (auto one = shut_.begin(); one != shut_.end();) {
      const bool over = one->end <= now();
      if (over) push_door(one->name, true, "may be open again: that it was shut is forgotten");
      one = over ? shut_.erase(one) : one + 1;
    }
  }

  // Looks at the doors that a scan shows. A leaf, or a person, that stands there long enough shuts a door.
  void look_at_doors() {
    if (laser_.new_data_arrived())
      if (const auto scan = laser_.get_update(); senders_.accepts(*scan)) scans_.add(scan);
    const orca::ScanPtr scan = scans_.take_until(history_.newest());
    if (!scan) return;
    const auto first = history_.at(orca::to_time_point(scan->stamp()));
    const auto last = history_.at(orca::last_beam_of(*scan));
    if (!first || !last) return;
    const Pose2 mount = orca::plane_pose(scan->pose());
    orca::nav::beams_of({scan->ranges(), scan->min_range(), scan->max_range(), scan->angle_start(),
                         scan->angle_increment(), *first * mount, *last * mount},
                        kSight, beams_);
    for (const WayPoint& point : ways_.points) {
      if (!point.door) continue;
      if (norm(point.place - first->position()) < kSight)
        judge(point);
      else
        suspected_.erase(point.name);
    }
  }

  void judge(const WayPoint& door) {
    const std::optional<bool> open = orca::planning::look_at(door, beams_).is_open(door.door->width);
    if (!open || *open) suspected_.erase(door.name);
    if (!open) return;
    if (*open) return note_open(door.name);
    const TimePoint since = suspected_.emplace(door.name, now()).first->second;
    if (orca::to_seconds(now() - since) >= kSure) note_shut(door.name);
  }

  void note_open(const std::string& door) {
    if (std::erase_if(shut_, [&](const ShutDoor& one) { return one.name == door; }) == 0) return;
    // It was in vain because the door was shut.
    std::erase_if(blocked_, [&](const Blockage& one) { return one.to == door; });
    push_door(door, true, "is open");
  }

  void note_shut(const std::string& door) {
    const TimePoint end = now() + orca::from_seconds(*forget_after_);
    const auto known = std::ranges::find(shut_, door, &ShutDoor::name);
    if (known != shut_.end()) {
      known->end = end;
      return;
    }
    shut_.push_back({door, end});
    push_door(door, false, "is shut");
  }

  void push_door(const std::string& name, bool passable, const std::string& what) {
    log_info(orca::in_quotes(name) + " " + what);
    const auto found = ways_.find(name);
    if (!found) return;
    const WayPoint& point = ways_.points[*found];
    auto door = doors_.loan();
    door->name() = name;
    door->coordinate().point().x(point.place.x);
    door->coordinate().point().y(point.place.y);
    door->orientation().orientation().yaw(point.door->direction);
    door->door_width().distance(point.door->width);
    door->door_leaf_exists(!passable);
    door->passable(passable);
    doors_.push(std::move(door));
  }

  orca::Status on_blocked(const ObjectPtr<Route>& route) {
    if (route->legs().empty())
      return orca::fail(orca::Code::invalid_argument, "it has no leg; its first one is what is blocked");
    const auto& leg = route->legs().front();
    Blockage blockage{route->name(),
                      leg.name(),
                      {leg.x(), leg.y()},
                      X_WR_.position(),
                      now() + orca::from_seconds(*forget_after_)};
    if (const auto place = place_at(ways_, blockage.goal); blockage.to.empty() && place)
      blockage.to = ways_.points[*place].name;
    log_info("the leg from " + (blockage.from.empty() ? "here" : orca::in_quotes(blockage.from)) + " to " +
             (blockage.to.empty() ? "the goal" : orca::in_quotes(blockage.to)) + " is blocked");
    blocked_.push_back(std::move(blockage));
    return orca::ok();
  }

  // Returns the index of the place where something is, of a map in the same frame.
  [[nodiscard]] static std::optional<std::size_t> place_at(const Ways& ways, Vec2 place) {
    const auto is_there = [&](const WayPoint& point) { return norm(point.place - place) < kSame; };
    const auto found = std::ranges::find_if(ways.points, is_there);
    if (found == ways.points.end()) return std::nullopt;
    return static_cast<std::size_t>(found - ways.points.begin());
  }

  // Returns the topological map in the frame of the cells.
  [[nodiscard]] Ways ways_in_map() const {
    const Pose2 X_MW = inverse(floor_.X_WM());
    Ways ways = ways_;
    for (WayPoint& point : ways.points) {
      point.place = X_MW * point.place;
      if (point.door) point.door->direction = orca::wrapped(X_MW.yaw + point.door->direction);
    }
    return ways;
  }

  // Returns whether a leg that is blocked leads to a point of the map, or to the goal.
  [[nodiscard]] bool leads_to(const Blockage& one, const WayPoint& point) const {
    return one.to.empty() ? norm(floor_.X_WM() * point.place - one.goal) < kSame : one.to == point.name;
  }

  // Returns whether a door is shut, or was tried in vain: from another side it is the same door.
  [[nodiscard]] bool is_closed(const WayPoint& point) const {
    return point.door &&
           (std::ranges::any_of(shut_, [&](const auto& one) { return one.name == point.name; }) ||
            std::ranges::any_of(blocked_, [&](const auto& one) { return one.to == point.name; }));
  }

  [[nodiscard]] bool is_blocked_between(const WayPoint& a, const WayPoint& b) const {
    return std::ranges::any_of(blocked_, [&](const Blockage& one) {
      return (one.from == a.name && leads_to(one, b)) || (one.from == b.name && leads_to(one, a));
    });
  }

  // Returns whether driving straight to a point from where the robot is was in vain: about there it was blocked.
  [[nodiscard]] bool is_blocked_from_here(const WayPoint& to) const {
    constexpr double kAbout = 2.0;  // [m]
    return !to.door && std::ranges::any_of(blocked_, [&](const Blockage& one) {
      return leads_to(one, to) && norm(one.robot - X_WR_.position()) < kAbout;
    });
  }

  // The last legs that lead by where a robot was blocked before the goal: they end as the one that it drove.
  void block_last_legs(const Ways& ways, std::size_t goal, std::vector<bool>& legs) const {
    constexpr double kDetour = 1.0;  // [m]
    const WayPoint& end = ways.points[goal];
    for (const Blockage& one : blocked_) {
      if (end.door || !leads_to(one, end)) continue;
      const Vec2 robot = seen_from(floor_.X_WM(), one.robot);
      const std::vector<double> costs = costs_from(floor_.grid(), ways, robot);
      for (std::size_t i = 0; i < legs.size(); ++i) {
        const auto& leg = ways.legs[i];
        if (leg.from != goal && leg.to != goal) continue;
        const std::size_t begin = leg.to == goal ? 2 * leg.from + leg.from_side : 2 * leg.to + leg.to_side;
        if (costs[begin] + norm(end.place - robot) < leg.cost + kDetour) legs[i] = true;
      }
    }
  }

  /// The parts of ways that are known to be blocked now.
  struct Blocked {
    std::vector<bool> from_here;  // straight from the robot to each point
    std::vector<bool> points;     // doors
    std::vector<bool> legs;
  };

  [[nodiscard]] Blocked find_blocked(const Ways& ways, std::size_t goal) const {
    Blocked blocked;
    for (const WayPoint& point : ways.points) {
      blocked.from_here.push_back(is_blocked_from_here(point));
      blocked.points.push_back(is_closed(point));
    }
    for (const orca::planning::WayLeg& leg : ways.legs)
      blocked.legs.push_back(is_blocked_between(ways.points[leg.from], ways.points[leg.to]));
    block_last_legs(ways, goal, blocked.legs);
    return blocked;
  }

  // Returns the index of the goal among the points; one that is no point of the map becomes one, with legs to those around it.
  [[nodiscard]] std::size_t add_goal(Ways& ways, const std::string& name, Vec2 place) const {
    if (const auto known = place_at(ways, place)) return *known;
    const std::vector<double> costs = costs_from(floor_.grid(), ways, place);
    const std::size_t goal = ways.points.size();
    ways.points.push_back({.name = name, .place = place});
    for (std::size_t i = 0; i < costs.size(); ++i)
      if (costs[i] < kNoWay) ways.legs.push_back({i / 2, goal, costs[i] + 1e-3, false, i % 2, 0});
    return goal;
  }

  // Returns the cheapest way where what is blocked costs a toll.
  // @param start [m]  costs from the robot, as WayTolls has them.
  [[nodiscard]] static std::optional<FoundWay> find(const Ways& ways, std::size_t goal,
                                                    std::vector<double> start, const Blocked& blocked,
                                                    double toll) {
    std::vector<double> end(start.size(), kNoWay);
    end[2 * goal] = end[2 * goal + 1] = 0.0;
    std::vector<double> points;
    std::vector<double> legs;
    for (std::size_t i = 0; i < start.size(); ++i)
      if (blocked.from_here[i / 2]) start[i] += toll;
    for (const bool is_blocked : blocked.points) points.push_back(is_blocked ? toll : 0.0);
    for (const bool is_blocked : blocked.legs) legs.push_back(is_blocked ? toll : 0.0);
    return cheapest_way(ways, {start, end, points, legs});
  }

  orca::Result<orca::Loan<Route>> on_question(const ObjectPtr<GoalPoint>& goal) {
    if (floor_.grid().cells.empty() || !knows_pose_) return route_of({}, goal->name(), false);
    const auto& place = goal->coordinate().point();
    Ways ways = ways_in_map();
    const std::size_t end =
        add_goal(ways, goal->name(), seen_from(floor_.X_WM(), Vec2{place.x(), place.y()}));
    const std::vector<double> start =
        costs_from(floor_.grid(), ways, seen_from(floor_.X_WM(), X_WR_.position()));
    const Blocked blocked = find_blocked(ways, end);
    const std::optional<FoundWay> way = find(ways, end, start, blocked, *blocked_cost_);
    if (!way)
      return orca::fail(orca::Code::not_found, "no way of " + *ways_file_ + " leads from here to \"" +
                                                   goal->name() + "\"; give it the legs that are lacking");
    auto route = route_of(*way, goal->name(), true);
    const std::optional<FoundWay> open = find(ways, end, start, blocked, kNoWay);
    route->blocked(!open || open->cost > way->cost);
    return route;
  }

  [[nodiscard]] orca::Loan<Route> route_of(const FoundWay& way, const std::string& goal, bool known) const {
    auto route = orca::make_object<Route>();
    route->name() = goal;
    route->known(known);
    route->cost(way.cost);
    for (std::size_t i = 0; i + 1 < way.points.size(); ++i) {
      const WayPoint& point =
          ways_.points[way.points[i]];  // The goal, which may be a new point, is the last one.
      auto& leg = route->legs().emplace_back();
      leg.name() = point.name;
      leg.x(point.place.x);
      leg.y(point.place.y);
      leg.door(point.door.has_value());
      leg.direction(point.door ? point.door->direction : 0.0);
      leg.width(point.door ? point.door->width : 0.0);
      leg.cost(way.costs[i]);
    }
    return route;
  }

  static constexpr double kSame = 0.3;   // [m] within which a goal is a place of the map
  static constexpr double kSight = 5.0;  // [m] from which it judges a door
  static constexpr double kSure = 1.0;   // [s] for which a door must look shut: people walk through

  orca::PushProxy<orca::idl::RobotPose> localizer_{
      *this, "localizer", {.text = "Pose of the robot, in the frame of the topological map."}};
  orca::PushProxy<OccupancyGrid> world_{
      *this,
      "world",
      {.text = "The map with what was seen of late, by which it finds what the robot gets to."}};
  orca::PushProxy<orca::idl::LaserRangeReadings> laser_{
      *this, "laser", {.text = "Scans in which it sees whether doors are open.", .optional = true}};
  orca::QueryServer<GoalPoint, Route> question_{
      *this,
      "RouteQuery",
      &RouteServer::on_question,
      {.text = "The cheapest way from the robot to a goal, by legs."}};
  orca::SendServer<Route> blockages_{*this,
                                     "BlockedSend",
                                     &RouteServer::on_blocked,
                                     {.text = "A leg that cannot be driven: from the place in name, empty "
                                              "for where the robot is, to that of the first "
                                              "leg, or to its coordinates without a name."}};
  orca::PushServer<orca::idl::Door> doors_{
      *this, "DoorPush", {.text = "A door that is seen to be shut, or is not any more."}};
  orca::Param<std::string> ways_file_{
      *this, "ways", "", {.file = true, .fixed = true, .text = "File of the topological map (README)."}};
  orca::Param<double> blocked_cost_{
      *this,
      "blocked_cost",
      50.0,
      {.unit = "m",
       .min = 0.0,
       .text = "Way that the robot drives more rather than wait at a shut door or a blocked leg."}};
  orca::Param<double> forget_after_{
      *this,
      "forget_after",
      120.0,
      {.unit = "s",
       .min = 1.0,
       .text = "Time after which a blocked leg, or a shut door that is not seen, may be open."}};

  Ways ways_;  // in the frame of the goals
  orca::planning::Floor floor_{orca::planning::Floor::kMostToPlan};
  bool knows_pose_ = false;
  Pose2 X_WR_;
  orca::nav::PoseHistory history_;
  orca::WaitingScans scans_;
  std::vector<orca::nav::Beam> beams_;  // of the last scan
  std::vector<ShutDoor> shut_;
  std::vector<Blockage> blocked_;
  std::map<std::string, TimePoint> suspected_;  // doors that look shut, and since when
  orca::SenderWatch senders_{host()};
};

}  // namespace

ORCA_COMPONENT(RouteServer, "orca.RouteServer")
