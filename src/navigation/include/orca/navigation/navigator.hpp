// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/navigation/occupancy_map.hpp"
#include "orca/navigation/path_driver.hpp"
#include "orca/navigation/path_planner.hpp"
#include "orca/navigation/pure_pursuit.hpp"

namespace orca::nav {

/// The place where the robot should go.
struct Errand {
  Vec2 place;            ///< map frame.
  bool passing = false;  ///< It need not stop there.
};

/// The rules of a Navigator.
struct NavigatorRules {
  Pursuit pursuit;
  PlanWishes wishes;
  double cell = 0.05;         ///< [m] side of a cell of the map.
  double extent = 16.0;       ///< [m] of the map, around the robot.
  double replan_every = 0.5;  ///< [s] at which a better path is looked for.
  double patience = 1.0;      ///< [s] of standing blocked before it recovers.
  RecoveryOrder recoveries = kUsualRecoveries;
};

/// The way from scans to motion: it keeps the map, plans, follows the path, and recovers where nothing leads on. It plans when
/// there is no path to the place, when the path is blocked, and now and then in case there is a better one.
///
/// After each recovery of its PathDriver it plans again. To clear its map it also forgets what it has seen farther than 1.5 m away, for that may be
/// old.
///
/// Thread contract: one thread at a time.
class Navigator {
 public:
  explicit Navigator(const Footprint& footprint, const NavigatorRules& rules);

  /// Takes over other rules; the sizes of the map stay.
  void set_rules(const NavigatorRules& rules);
  /// Takes over a scan that was taken about where the robot is now.
  void hear(std::span<const Beam> scan, const Pose2& pose);
  /// Returns the motion of the next moment; none while the robot is said to be outside of what the map covers: the next scan moves
  /// that.
  [[nodiscard]] Steer steer(const Moment& moment, const Errand& errand);
  /// Returns the place on the path that is as far ahead as it looks, map frame; nothing while it recovers or no path leads on.
  [[nodiscard]] std::optional<Vec2> ahead(const Moment& moment) const;
  /// Returns how far the robot can drive straight on [m], at most 1.5 m.
  [[nodiscard]] double room_ahead(const Moment& moment) const;
  /// Returns what is left of the path [m]; nothing while there is none.
  [[nodiscard]] std::optional<double> way_left() const {
    return path().empty() ? std::nullopt : std::optional(path().length() - driver_.along());
  }
  /// Forgets the path: the robot does something else now.
  void drop_path();

  /// Names what it knows besides its rules and its map, so that another one can go on from there.
  [[nodiscard]] auto state() {
    return std::tie(driver_, kept_, planned_for_, planned_at_, begun_, news_, doubts_);
  }
  /// Takes over the map of another one, as OccupancyMap::packed() gives it.
  /// @return whether it had the same size.
  [[nodiscard]] bool unpack_map(std::string_view text) { return map_.unpack(text); }

  [[nodiscard]] const Path& path() const { return kept_.plan().path; }
  [[nodiscard]] const OccupancyMap& map() const { return map_; }
  /// Returns the recovery that goes on; nothing: none does.
  [[nodiscard]] std::optional<Recovery> recovery() const { return driver_.recovery(); }
  /// Returns how often it has recovered since the last drop_path().
  [[nodiscard]] int recoveries() const { return driver_.recoveries(); }

 private:
  void keep_path(const Moment& moment, const Errand& errand);
  void replan(const Moment& moment, const Errand& errand);
  void doubt(Vec2 robot);
  [[nodiscard]] bool covers(Vec2 place) const;
  [[nodiscard]] bool is_known(Vec2 echo) const;
  [[nodiscard]] bool has_seen(Vec2 point) const;

  Footprint footprint_;
  NavigatorRules rules_;
  PathDriver driver_;
  OccupancyMap map_;
  KeptPlan kept_;
  std::optional<Vec2> planned_for_;
  TimePoint planned_at_{};
  bool begun_ = false;   // a scan has come
  bool news_ = false;    // a scan has come since the last look at the path
  bool doubts_ = false;  // what scans look through is to be cleared
};

}  // namespace orca::nav
