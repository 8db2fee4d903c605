// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/localization.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <span>

#include "motion.hpp"
#include "orca/geometry/angle.hpp"
#include "orca/hw/scene.hpp"

namespace orca::batch {
namespace {

using Steps = std::span<const Scene::Step>;
using Says = PoseClaim::Says;

constexpr double kRight = 0.1;                               // [m]
constexpr double kRightTurn = 5.0 * std::numbers::pi / 180;  // [rad]
constexpr double kWrong = 0.5;                               // [m]
// The limits for a localizer after a kidnapping: as long or as far as that, whichever is more.
struct Patience {
  Duration time;
  double way;  // [m]
};
constexpr Patience kToNotice{std::chrono::seconds(3), 1.0};
constexpr Patience kToFind{std::chrono::seconds(15), 8.0};

struct Counts {
  std::size_t kidnapped = 0, noticed = 0, found = 0;
  std::size_t claims = 0, several = 0;
  std::size_t settled = 0, wrong = 0;  // of the claims, those that are not too near to a kidnapping
};

// Returns where the robot truly was; nothing before the first pose, after the last, and while it was carried.
std::optional<Pose2> pose_at(Steps steps, TimePoint time) {
  const Steps after = batch::since(steps, time);
  if (after.empty() || (after.size() == steps.size() && after[0].time > time)) return std::nullopt;
  if (after[0].time == time) return after[0].pose;
  const Scene::Step& next = after[0];
  const Scene::Step& last = steps[steps.size() - after.size() - 1];
  if (is_carried(last, next)) return std::nullopt;
  const double part = to_seconds(time - last.time) / to_seconds(next.time - last.time);
  const Vec2 at = last.pose.position() + part * (next.pose.position() - last.pose.position());
  return Pose2{at.x, at.y, wrapped(last.pose.yaw + part * wrapped(next.pose.yaw - last.pose.yaw))};
}

double off(const PoseClaim& claim, const Pose2& truth) {
  return norm(claim.X_WR.position() - truth.position());
}

bool is_right(const PoseClaim& claim, const Pose2& truth) {
  return claim.says == Says::place && off(claim, truth) <= kRight &&
         std::fabs(wrapped(claim.X_WR.yaw - truth.yaw)) <= kRightTurn;
}

// Returns whether a claim of which `holds` comes in time after the robot was carried off.
template <class Holds>
bool comes_in_time(const std::vector<PoseClaim>& claims, Steps stay, const Patience& patience, Holds holds) {
  for (const PoseClaim& claim : claims) {
    const auto truth = pose_at(stay, claim.stamp);
    if (!truth || !holds(claim, *truth)) continue;
    const Steps later = batch::since(stay, claim.stamp);
    return claim.stamp - stay[0].time <= patience.time ||
           way_of(stay.first(stay.size() - later.size())) <= patience.way;
  }
  return false;
}

// Counts what was claimed between two kidnappings.
void judge_stay(const std::vector<PoseClaim>& claims, Steps stay, bool was_carried, Counts& counts) {
  for (const PoseClaim& claim : claims) {
    const auto truth = pose_at(stay, claim.stamp);
    if (!truth) continue;
    ++counts.claims;
    if (claim.says == Says::several) ++counts.several;
    if (was_carried && claim.stamp - stay[0].time <= kToNotice.time) continue;
    ++counts.settled;
    if (claim.says == Says::place && off(claim, *truth) > kWrong) ++counts.wrong;
  }
  if (!was_carried) return;
  ++counts.kidnapped;
  const auto is_not_wrong = [](const PoseClaim& claim, const Pose2& truth) {
    return claim.says != Says::place || is_right(claim, truth);
  };
  counts.noticed += comes_in_time(claims, stay, kToNotice, is_not_wrong) ? 1 : 0;
  counts.found += comes_in_time(claims, stay, kToFind, is_right) ? 1 : 0;
}

void judge_robot(const std::vector<PoseClaim>& claims, Steps motion, Counts& counts) {
  for (std::size_t begin = 0; begin < motion.size();) {
    std::size_t end = begin + 1;
    while (end < motion.size() && !is_carried(motion[end - 1], motion[end])) ++end;
    judge_stay(claims, motion.subspan(begin, end - begin), begin > 0, counts);
    begin = end;
  }
}

std::optional<double> share(std::size_t some, std::size_t all) {
  return all == 0 ? std::nullopt : std::optional(static_cast<double>(some) / static_cast<double>(all));
}

}  // namespace

LocalizationShares judge_poses(const std::vector<PoseClaim>& claims, const Scene& scene) {
  Counts counts;
  for (const Scene::Robot& robot : scene.robots) {
    std::vector<PoseClaim> own;
    std::ranges::copy_if(claims, std::back_inserter(own), [&](const PoseClaim& claim) {
      return claim.robot == robot.name || (claim.robot.empty() && scene.robots.size() == 1);
    });
    if (!own.empty()) judge_robot(own, robot.motion, counts);
  }
  return {share(counts.noticed, counts.kidnapped), share(counts.found, counts.kidnapped),
          share(counts.wrong, counts.settled), share(counts.several, counts.claims)};
}

}  // namespace orca::batch
