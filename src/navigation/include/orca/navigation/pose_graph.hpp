// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "orca/geometry/pose2.hpp"

namespace orca::nav {

/// How much is known of a pose in the plane: the inverse of its covariance, in the frame in which the pose is given. Symmetric.
struct PoseInformation {
  double xx = 0.0, xy = 0.0, yy = 0.0;  ///< [1/m2]
  double xt = 0.0, yt = 0.0;            ///< [1/(m rad)]
  double tt = 0.0;                      ///< [1/rad2]
};

/// Returns the covariance of a pose of which so much is known, seen from a frame in which its own is turned by `yaw` [rad]: [m2, m rad, rad2] of x, y
/// and direction, row by row.
/// @pre  the information is positive definite.
/// @thread  pure function; any thread.
[[nodiscard]] std::array<double, 9> covariance_of(const PoseInformation& information, double yaw);

/// Returns how much is known of a pose that lies `step` from one that is known, each in its own frame.
/// @param travel  how much is known of the step, in the frame that it begins in.
/// @pre  both are positive definite.
/// @thread  pure function; any thread.
/// @source  Smith, Self and Cheeseman 1990: compounding.
[[nodiscard]] PoseInformation after(const PoseInformation& known, const Pose2& step,
                                    const PoseInformation& travel);

/// A measurement of one pose from another.
struct PoseRelation {
  std::size_t from = 0;         ///< The number of a pose.
  std::size_t to = 0;           ///< The number of another pose.
  Pose2 measured;               ///< The pose `to` seen from the pose `from`.
  PoseInformation information;  ///< How much the measurement knows, in the frame of `from`.
  /// Whether the measurement may be altogether wrong, as when a place was taken for another that looks like it. Then it counts the less,
  /// the less it fits to all others.
  bool doubtful = false;
};

/// Poses and what was measured between them. The relations name poses of the graph.
struct PoseGraph {
  std::vector<Pose2> poses;  ///< X_M, map frame.
  std::vector<PoseRelation> relations;
};

/// When to stop, and how to doubt.
struct PoseGraphOptions {
  int iterations = 50;
  /// It stops as soon as a step makes the misfit smaller by less than that share.
  double gain = 1e-7;
  /// Up to this misfit a doubtful relation counts in full: the parameter Phi of Agarwal and others.
  double doubted_from = 5.0;
};

/// How a graph came out.
struct PoseGraphFit {
  double misfit =
      0.0;  ///< Sum over the relations of e' I e, of which a doubtful one counts as it was weighted.
  int iterations = 0;
  bool solved =
      false;  ///< Whether each pose is tied to the first one, and numbers stayed finite. Else the poses are as before.
};

/// Returns what a relation misses, e' I e, where e is the difference between what was measured and what the two poses say: its place in the
/// frame of `from`, and 2 sin(a/2) for an angle of a (the chord, which is a for small angles and has no jump at pi).
[[nodiscard]] double misfit(const PoseRelation& relation, std::span<const Pose2> poses);

/// Begins with poses that fit the relations roughly, wherever they were: first the directions, as unit vectors in least squares, then the places.
/// The first pose stays. Doubtful relations do not count.
/// @return whether each pose is tied to the first one; if not, none has changed.
/// @source  Carlone and others, "Initialization techniques for 3D SLAM", ICRA 2015: chordal relaxation.
bool begin_anew(PoseGraph& graph);

/// Moves all poses but the first to where the relations fit best: Gauss and Newton, damped where a step would make it worse
/// (Levenberg and Marquardt), on a sparse Cholesky decomposition. Time grows about as the number of poses in graphs of buildings.
/// Thread contract: pure; any thread.
/// @source  Grisetti and others, "A tutorial on graph-based SLAM", 2010; for doubtful relations Agarwal and others, "Robust map optimization
///          using dynamic covariance scaling", ICRA 2013.
PoseGraphFit fit(PoseGraph& graph, const PoseGraphOptions& options = {});

}  // namespace orca::nav
