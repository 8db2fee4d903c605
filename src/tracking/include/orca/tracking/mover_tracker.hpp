// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "orca/geometry/vec2.hpp"
#include "orca/navigation/beams.hpp"
#include "orca/tracking/free_floor.hpp"
#include "orca/tracking/walk_estimate.hpp"

namespace orca::tracking {

/// Something that moves: a person, or another robot. A plain value.
struct Mover {
  std::uint32_t number = 0;     ///< From 1 on; the same one keeps it.
  Vec2 place;                   ///< [m] of its middle, in the frame of the scans.
  Vec2 velocity;                ///< [m/s]
  double radius = 0.0;          ///< [m] of the upright cylinder that it counts as.
  double place_error = 0.0;     ///< [m] standard deviation in each direction.
  double velocity_error = 0.0;  ///< [m/s] the same of the velocity.
  double unseen = 0.0;          ///< [s] since a scan saw it.
};

/// Finds and follows what moves around a robot.
///
/// A reading on floor that was free of late (FreeFloor) is one of something that moves. Readings near to where a mover is expected are
/// its own; each mover has a WalkEstimate. Others that lie together, no wider than a person, are perhaps a new one:
/// it is reported when it has come kWay far, at kSlowest or faster.
///
/// A mover out of sight - hidden, or beside the field of view - goes on as it went for kUnseen. One that is not where beams look through is
/// forgotten after kMissed. Who stands still for FreeFloor::kLately is furniture until he moves on.
///
/// Thread contract: as for a container.
/// @source  Schulz, Burgard, Fox and Cremers, "People Tracking with Mobile Robots Using Sample-based Joint Probabilistic Data Association
///          Filters", IJRR 22(2), 2003, for people as changes of the free space; Bar-Shalom, Li and Kirubarajan, "Estimation with
///          Applications to Tracking and Navigation", 2001, ch. 6.3, for the filter. Readings go to the nearest mover, as people seldom
///          come nearer to each other than their legs stand apart.
class MoverTracker {
 public:
  static constexpr double kRange = 6.0;    ///< [m] from the sensor; what is farther away does not count.
  static constexpr double kWay = 0.3;      ///< [m]
  static constexpr double kSlowest = 0.3;  ///< [m/s]
  static constexpr double kUnseen = 2.0;   ///< [s]
  static constexpr double kMissed = 0.5;   ///< [s]
  static constexpr double kBody = 0.3;     ///< [m] radius of a person: lasers see the legs only.

  /// Takes a scan, in a frame in which what stands still keeps its place: the odometry's.
  /// @param time [s]  at which it was taken; times only grow.
  void see(std::span<const nav::Beam> scan, double time);
  /// Returns those that move, as of the last scan.
  [[nodiscard]] std::vector<Mover> movers() const;
  /// Forgets all.
  void clear();

 private:
  struct Track {
    std::uint32_t number = 0;  // 0: it is not reported yet
    WalkEstimate walk;
    Vec2 born;
    double seen_at = 0.0;     // [s]
    double missed_for = 0.0;  // [s] in which beams looked through its place
    int sightings = 0;
    double half_width = 0.0;  // [m]
  };

  void find_fresh(std::span<const nav::Beam> scan, double time);
  void predict(double elapsed);
  void update(double time, double elapsed);
  void correct(Track& track, std::span<const Vec2> own, double time);
  [[nodiscard]] bool is_part_of_furniture(std::span<const Vec2> group) const;
  void begin_new(double time);

  FreeFloor floor_;
  std::vector<Track> tracks_;
  std::vector<Vec2> fresh_;  // readings on floor that was free
  std::vector<Vec2> still_;  // others
  double time_ = 0.0;
  bool begun_ = false;
  std::uint32_t last_number_ = 0;
};

}  // namespace orca::tracking
