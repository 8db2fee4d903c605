// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/navigation/pose_graph.hpp"
#include "orca/navigation/scan_match.hpp"
#include "orca/navigation/surface.hpp"

namespace orca::nav {

/// How wrong a way by odometry may be: standard deviations. The defaults are wide, for a robot of which nothing is known; what they decide is where
/// a scan is looked for, and who wins where scans say little.
struct TravelErrors {
  double place = 0.05;           ///< [m] in any case
  double place_per_way = 0.1;    ///< [m/m]
  double place_per_turn = 0.05;  ///< [m/rad]
  double turn = 0.03;            ///< [rad] in any case
  double turn_per_way = 0.05;    ///< [rad/m]
  double turn_per_turn = 0.1;    ///< [rad/rad]
};

/// How a map is made. The defaults are for lasers in buildings; those of the Intel log are the same.
struct SlamOptions {
  double node_way = 0.2;     ///< [m] after which a scan becomes a node.
  double node_turn = 0.1;    ///< [rad] after which it does.
  std::size_t submap = 8;    ///< nodes of a submap; the next one begins halfway.
  double least_share = 0.5;  ///< of a scan's points on the map for a match to count.
  double loop_share = 0.7;   ///< for a loop to count.
  double loop_score = 0.6;   ///< the same before it is refined.
  double loop_reach =
      4.0;  ///< [m] from a submap's middle at which a loop is looked for, besides what may have drifted.
  std::size_t loops_per_node = 8;  ///< at most: of the submaps nearest to it.
  double drift = 0.02;             ///< [m] per m of way since the last loop.
  std::size_t fit_every = 10;      ///< nodes after which loops are worked in.
  MatchOptions match;
  TravelErrors travel;
};

/// A scan and where it was taken.
struct SlamNode {
  Pose2 X_OR;                      ///< Odometry's.
  Pose2 X_LR;                      ///< In the frame of the scans laid one upon the other, without loops.
  Pose2 X_MR;                      ///< Map frame, as far as is known now.
  std::vector<SurfacePoint> scan;  ///< Robot frame.
  Vec2 sensor;                     ///< Where it was taken from, robot frame: what lies between is free.
};

/// Some nodes that follow each other, which were laid one upon the other.
struct SlamStretch {
  std::size_t first = 0;  ///< The number of a node.
  std::size_t count = 0;
  double way = 0.0;  ///< [m] that the robot had driven when the last of them came.
};

/// All that a Slam knows of a building, for another one to go on with, in this run or on another day.
struct SlamMemory {
  std::vector<SlamNode> nodes;
  std::vector<PoseRelation> relations;
  std::vector<SlamStretch> submaps;
  std::size_t loops = 0;
  double way = 0.0;  ///< [m] driven
};

/// Checks what comes from a file.
/// @errors  data_loss if a number is not finite, or something names a node that is not there.
/// @thread  pure function; any thread.
[[nodiscard]] Status check(const SlamMemory& memory);

/// Finds where a robot is and what its map is, at once: each scan is laid into a submap of some nodes before it; a scan that comes by an older
/// submap and fits there closes a loop; the poses of all nodes go where all these relations fit best.
///
/// Thread contract: one thread at a time.
/// @source  the parts are those of Hess and others, "Real-time loop closure in 2D LIDAR SLAM", ICRA 2016; README.md says what differs.
class Slam {
 public:
  explicit Slam(SlamOptions options = {});
  /// Goes on with what another one knows. The robot is at none of its nodes: enter() comes before see().
  /// @pre  check(memory).ok()
  explicit Slam(SlamMemory memory, SlamOptions options = {});
  ~Slam();

  /// Takes a scan of a robot whose place in the map was found by others: it was switched off, or carried there.
  /// @param X_OR  by odometry, which may count from another place than before.  @param X_MR  where the robot is, map frame.
  /// @param sensor  where the scan was taken from, robot frame.
  /// @pre  there is a node.
  void enter(std::span<const SurfacePoint> scan, const Pose2& X_OR, const Pose2& X_MR, Vec2 sensor = {});

  /// Takes the next scan. The map frame is odometry's at the first one.
  /// @param X_OR    by odometry, when it was taken.
  /// @param sensor  where it was taken from, robot frame.
  /// @return where the robot is, map frame.
  Pose2 see(std::span<const SurfacePoint> scan, const Pose2& X_OR, Vec2 sensor = {});

  /// Looks once more for all places that were seen twice, and fits all poses: worth its time (about that of all so far) before a map is kept.
  void finish();

  [[nodiscard]] std::span<const SlamNode> nodes() const { return nodes_; }
  [[nodiscard]] std::size_t loops() const { return loops_; }
  /// Returns all that another one needs to go on.
  [[nodiscard]] SlamMemory memory() const;
  /// Returns how much is known of the robot's pose in the map around it, in its own frame: what the scans say, and where they say nothing,
  /// what odometry does.
  /// @param X_OR  by odometry now.
  [[nodiscard]] PoseInformation known_at(const Pose2& X_OR) const;

 private:
  struct Submap;

  [[nodiscard]] std::optional<ScanMatch> lay(std::span<const SurfacePoint> scan, const Pose2& X_LR) const;
  void add_node(std::span<const SurfacePoint> scan, const Pose2& X_OR, const Pose2& X_LR,
                const std::optional<ScanMatch>& match);
  void grow_submaps();
  void add_to(Submap& submap, std::size_t node);
  void complete_submaps();
  void close_loops(std::size_t node);
  bool close_loop(std::size_t node, Submap& submap, double way, double turn);
  const ScanSearch& search_of(Submap& submap);
  void work_in(int iterations);

  SlamOptions options_;
  std::vector<SlamNode> nodes_;
  std::vector<std::unique_ptr<Submap>> submaps_;
  std::vector<PoseRelation> relations_;
  std::size_t loops_ = 0;
  std::size_t fitted_ = 0;  // nodes at the last fit
  std::size_t loops_fitted_ = 0;
  double way_ = 0.0;               // [m] driven
  double way_at_loop_ = 0.0;       // [m] when a place was last seen again
  PoseInformation known_;          // of the last node's pose, its frame
  std::vector<Submap*> searched_;  // those that have a search, the last used one at the end
};

}  // namespace orca::nav
