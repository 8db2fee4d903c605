// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/geometry/vec2.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca {
struct Scene;
}

namespace orca::batch {

/// A goal of an experiment: where the frame of a robot has to be, in truth. A plain value.
struct Goal {
  std::string robot{};                          ///< Its name in the simulator; empty: the only one.
  std::string place{};                          ///< Name of a place of the world; empty: `position` counts.
  Vec2 position{};                              ///< [m] In the world frame.
  double radius = 0.0;                          ///< [m] Largest distance from there.
  std::optional<double> heading{};              ///< [rad] In the world frame; nothing: any.
  double heading_tolerance = std::numbers::pi;  ///< [rad] Largest difference from `heading`.
  Duration hold{0};                             ///< Time that the robot has to stay there without a break.
  xml::Position declared_at{};                  ///< In the experiment's file.
};

/// Returns a goal for people, and so that two goals with the same text are the same:
/// "Dewey within 0.3 m of 4.2 9.8, facing 1.57 rad +- 0.35 rad, for 0.5 s".
[[nodiscard]] std::string goal_text(const Goal& goal);

/// Returns ok if the goal can be judged in this scene, which may be one of a run that has not begun.
/// @errors  not_found if the scene has no such robot or place; failed_precondition if the goal names no robot and there are several,
///          or none.
/// @thread  no shared state; any thread.
[[nodiscard]] Status can_judge(const Goal& goal, const Scene& scene);

/// A word of a component on a goal of its robot: reached, or given up. A plain value.
struct GoalClaim {
  std::string robot{};  ///< Empty: not known.
  TimePoint time{};     ///< By the run's clock.
  bool reached = false;
};

/// The judgement of a run on its goals. A plain value.
struct Judgement {
  std::uint32_t reached = 0;  ///< Goals that robots reached.
  std::uint32_t missed = 0;   ///< Goals that were given up, or claimed wrongly, before they were reached.
  std::uint32_t claimed = 0;  ///< Claims that a goal was reached.
  std::uint32_t claimed_wrongly = 0;  ///< Those at which the robot was not in the goal, or had no goal left.
  std::uint32_t not_claimed = 0;      ///< Goals that were reached and that no component claimed.
  std::optional<TimePoint> done{};    ///< Time at which the last goal was reached, if all were.
  friend bool operator==(const Judgement&, const Judgement&) = default;
};

/// Judges by the true poses, ten a second and the one at the end, whether robots reached their goals.
///
/// The goals of each robot are to be reached in their order, and the k-th claim of its components is one on its k-th goal. A goal
/// counts as reached at the first true pose inside its radius and tolerance from which on all poses of the next `hold` are inside; if
/// the run ends earlier, all that are left. The pose has to be before a claim on the goal, or the one after it, 0.1 s later at most:
/// a goal that was claimed or given up too early is missed, and the next one is judged.
///
/// @param scene   of a run that kept the motion of its robots.
/// @param claims  in the order of their times.
/// @param end     of the run.
/// @errors  of can_judge().
/// @thread  no shared state; any thread.
[[nodiscard]] Result<Judgement> judge_goals(const std::vector<Goal>& goals, const Scene& scene,
                                            const std::vector<GoalClaim>& claims, TimePoint end);

}  // namespace orca::batch
