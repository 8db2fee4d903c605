// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/scan_match.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace orca::nav {
namespace {

constexpr int kLeastPoints = 10;
constexpr double kCloser = 0.02;  // [1/m], [rad/m] of the reach: a smaller step lets it shrink

/// The normal equations of one step of refine(), in the frame of the scan.
struct Step {
  Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  // By lines only: the nearest of some points that are far apart, as at the far end of a corridor, says nothing of the way along it.
  Eigen::Matrix3d known = Eigen::Matrix3d::Zero();
  int pulled = 0;
  double squares = 0.0;
  double fit = 0.0;

  // A residual e [m] whose derivative by the place is `towards` and by the direction is `turned`; all in the scan's frame.
  void add(double e, Vec2 towards, double turned, double weight) {
    const Eigen::Vector3d j(towards.x, towards.y, turned);
    h += weight * j * j.transpose();
    b += weight * e * j;
  }
};

// @param back  the direction of the map's x axis, seen from the scan.
void pull(Step& step, Vec2 point, Vec2 there, const SurfacePoint& surface, Vec2 back, double reach) {
  const Vec2 off = rotated(there - surface.at, back);
  const Vec2 normal = rotated(surface.normal, back);
  // Half as strong at a third of the reach.
  const auto weight = [&](double e) { return 1.0 / (1.0 + 9.0 * e * e / (reach * reach)); };
  const auto along = [&](Vec2 axis) {
    const double e = dot(off, axis);
    step.add(e, axis, dot(axis, {-point.y, point.x}), weight(e));
    step.squares += e * e;
  };
  ++step.pulled;
  step.fit += weight(surface.normal == Vec2{} ? norm(off) : dot(off, normal));
  if (surface.normal == Vec2{}) {
    along({1.0, 0.0});
    along({0.0, 1.0});
  } else {
    const Eigen::Matrix3d before = step.h;
    along(normal);
    step.known += step.h - before;
  }
}

Step step_at(std::span<const SurfacePoint> scan, const SurfaceMap& map, const Pose2& X_MR, double reach) {
  Step step;
  const Vec2 ahead = direction(X_MR.yaw);
  const Vec2 back = direction(-X_MR.yaw);
  for (const SurfacePoint& point : scan) {
    const Vec2 there = X_MR.position() + rotated(point.at, ahead);
    const SurfacePoint* surface = map.nearest(there, reach);
    if (surface == nullptr) continue;
    // The other side of a thin wall is another surface.
    const Vec2 seen = rotated(point.normal, ahead);
    if (dot(seen, surface->normal) < 0.0) continue;
    pull(step, point.at, there, *surface, back, reach);
  }
  return step;
}

// Lets the guess pull.
// @param moved  the pose seen from the guess.  @param unit  the weight of a point by its information.
void hold(Step& step, const PoseInformation& held, const Pose2& moved, double unit) {
  Eigen::Matrix3d known;
  known << held.xx, held.xy, held.xt, held.xy, held.yy, held.yt, held.xt, held.yt, held.tt;
  const Vec2 ahead = direction(moved.yaw);
  Eigen::Matrix3d by_move = Eigen::Matrix3d::Identity();
  by_move.topLeftCorner<2, 2>() << ahead.x, -ahead.y, ahead.y, ahead.x;
  const Eigen::Matrix3d pull = unit * by_move.transpose() * known;
  step.h += pull * by_move;
  step.b += pull * Eigen::Vector3d(moved.x, moved.y, moved.yaw);
}

}  // namespace

std::optional<ScanMatch> refine(std::span<const SurfacePoint> scan, const SurfaceMap& map, const Pose2& guess,
                                const MatchOptions& options, const PoseInformation& held) {
  const double unit = options.error * options.error * options.together;
  ScanMatch match{guess, {}};
  double reach = options.reach;
  for (int i = 0; i < options.iterations; ++i) {
    Step step = step_at(scan, map, match.X_MR, reach);
    if (step.pulled < kLeastPoints) return std::nullopt;
    hold(step, held, seen_from(guess, match.X_MR), unit);
    // A little stiffness keeps a direction that nothing holds where it is.
    Eigen::Matrix3d h = step.h;
    h.diagonal().array() += 1e-3;
    const Eigen::Vector3d move = h.ldlt().solve(-step.b);
    match.X_MR = match.X_MR * Pose2{move[0], move[1], move[2]};
    const double moved = move.cwiseAbs().maxCoeff();
    if (moved < options.still && reach <= options.inlier) break;
    // Only from a place that holds still: else points that were drawn to a wrong surface would stay there.
    if (moved < kCloser * reach) reach = std::max(options.inlier, reach * 0.7);
  }
  const Step last = step_at(scan, map, match.X_MR, options.inlier);
  if (last.pulled < kLeastPoints) return std::nullopt;
  match.share = last.pulled / static_cast<double>(scan.size());
  match.fit = last.fit / static_cast<double>(scan.size());
  match.spread = std::sqrt(last.squares / last.pulled);
  const Eigen::Matrix3d known = last.known / unit;
  match.information = {known(0, 0), known(0, 1), known(1, 1), known(0, 2), known(1, 2), known(2, 2)};
  return match;
}

}  // namespace orca::nav
