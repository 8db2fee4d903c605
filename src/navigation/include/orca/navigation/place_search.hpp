// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/navigation/known_map.hpp"
#include "orca/navigation/map_localizer.hpp"
#include "orca/navigation/particles.hpp"
#include "orca/navigation/scan_match.hpp"

namespace orca::nav {

/// Which places a search takes.
struct PlaceSearchOptions {
  double least_score = 0.4;  ///< [1]
  double margin = 0.15;      ///< [1] by which the score of a place may be worse than the best.
  double apart = 0.5;        ///< [m] between two places, unless
  double apart_turn =
      0.35;  ///< [rad] their directions differ by more. The best of those nearer to each other is taken.
  std::size_t most = 20;  ///< places.
};

/// The search for all places of a map in which a scan may have been taken, in all directions, a part at a time: no step takes long, so a robot
/// can go on with its work. The robot can only be where the map is free.
///
/// Thread contract: one thread at a time.
/// @source  branch and bound as in ScanSearch.
class PlaceSearch {
 public:
  /// @param map   outlives this.
  /// @param scan  robot frame; about a hundred points are enough.
  PlaceSearch(const KnownMap& map, std::vector<SurfacePoint> scan, const PlaceSearchOptions& options = {});

  /// Goes on for about `looks` values of the map that are looked up: a million take some milliseconds.
  /// @return whether it is complete.
  bool step(std::size_t looks);
  /// Returns the places so far, the best first.
  [[nodiscard]] const std::vector<Found>& found() const { return found_; }
  /// Returns whether there may be more of them, which were left out because it keeps no more.
  [[nodiscard]] bool left_some_out() const { return found_.size() >= options_.most; }

 private:
  struct Block {
    std::int32_t turn;
    Cell corner;
    std::int32_t sum;
  };

  void look_in_direction(int turn);
  void sort_blocks();
  void look_into(const Block& block, int level);
  void keep(const Block& place);
  [[nodiscard]] Pose2 pose_of(const Block& place) const;
  [[nodiscard]] bool is_better(const Block& block, int level) const;
  [[nodiscard]] std::vector<Cell> turned_by(int turn) const;

  const KnownMap& map_;
  std::vector<SurfacePoint> scan_;
  PlaceSearchOptions options_;
  int turns_;
  double full_;                    // sum of a perfect fit
  const std::vector<Cell>& tops_;  // the map's free blocks
  std::vector<Block> blocks_;      // of them and each direction, those that are worth it
  std::vector<std::vector<Cell>> turned_;
  std::size_t next_ = 0;  // direction, then block
  bool sorted_ = false;
  std::size_t looked_ = 0;
  std::vector<Found> found_;
};

/// How many echoes lie behind the map's walls, of those on walls or behind; those of long ago count less.
struct SeenThrough {
  double behind = 0.0;
  double at_walls = 0.0;  ///< On walls or behind.

  void note(const Explanation& seen);
  void add(const SeenThrough& other);
  /// Returns whether they are more than a share [1].
  [[nodiscard]] bool is_more_than(double share) const { return behind > share * at_walls; }
};

/// Other places near the one where a robot is believed to be, at which it may be as well. They follow odometry alone. Until they are refuted,
/// or the robot has come to other views, its place is not known better than they lie apart.
///
/// Thread contract: one thread at a time.
/// @source  Olson 2009: the covariance of a match comes from all places that the prior allows, not from the best one alone. The moments of
///          a mixture: Bar-Shalom, Li and Kirubarajan, "Estimation with Applications to Tracking and Navigation", 2001, 1.4.16.
class Rivals {
 public:
  /// Says that a scan has drawn the robot away from where the wheels have it, by more than these are wrong as a rule. Either may be right:
  /// wheels slip, and furniture is moved.
  void contradict(const PoseSpread& by_wheels);
  /// Looks in all of a wide prior for places that explain a scan nearly as well as the one where it was laid.
  /// @param scan  its echoes corrected as they were laid.
  void look_about(const PoseSpread& prior, const ScanMatch& laid, const RobotScan& scan, const KnownMap& map,
                  const LocalizerOptions& options);
  /// Moves them as Particles::move() does.
  void move(const Pose2& step, const std::array<double, 3>& deviations);
  /// Judges them by a scan, and forgets those that need no thought any more: where light would have to go through walls, but not where the
  /// robot is believed to be; those that the wheels have lost; and all when the robot has come to other views.
  /// @param believed  how the scan lies where the robot is believed to be.
  void judge(const RobotScan& scan, const KnownMap& map, const Explanation& believed,
             const LocalizerOptions& options);
  void clear() { rivals_.clear(); }

  [[nodiscard]] bool empty() const { return rivals_.empty(); }
  /// Returns how well the place is known, with them: the mean stays.
  [[nodiscard]] PoseSpread with(PoseSpread believed) const;

 private:
  struct Rival {
    PoseSpread where;
    double odds;  // against the place that is believed
    SeenThrough there;
  };
  std::vector<Rival> rivals_;
  SeenThrough believed_;  // since there are any
  double way_ = 0.0;      // [m] driven since a scan contradicted the wheels last
};

}  // namespace orca::nav
