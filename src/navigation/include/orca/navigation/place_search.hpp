// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "orca/navigation/known_map.hpp"

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

}  // namespace orca::nav
