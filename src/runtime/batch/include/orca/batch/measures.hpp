// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "orca/base/time.hpp"

namespace orca {
struct Scene;
}

namespace orca::batch {

/// Why a run did not succeed, by the true motion of its robots: the first of these that holds. The names are those of the table of
/// results, and never change.
enum class Failure : std::uint8_t {
  none,         ///< It succeeded, or what ended it says nothing of its motion.
  crash,        ///< Its process or a component failed, or did not answer any more.
  contact,      ///< A robot touched something.
  lost,         ///< A component claimed a goal while its robot was not there.
  overload,     ///< More than half of the laps of a component still computed when the next was due.
  trap,         ///< In the last 20 s no robot left an area of 1 m, and none turned to and fro there.
  oscillation,  ///< No robot left it, and one turned to and fro ten times or more.
  time_out      ///< A robot was still on its way.
};

[[nodiscard]] const char* name_of(Failure failure);
/// Returns the failure of that name; nothing if there is none.
[[nodiscard]] std::optional<Failure> failure_of(std::string_view name);

/// The motion of the robots of a run, all together. Unknown measures are missing: without a simulated robot all. A plain value.
struct Measures {
  std::optional<double> claimed{};
  std::optional<double> claimed_wrongly{};
  std::optional<double> not_claimed{};
  std::optional<double> way{};
  std::optional<double> way_ratio{};
  std::optional<double> spl{};
  std::optional<double> barn_score{};
  std::optional<double> clearance{};
  std::optional<double> clearance_p5{};
  std::optional<double> clearance_mean{};
  std::optional<double> curvature{};
  std::optional<double> jerk{};
  std::optional<double> reversals{};
  std::optional<double> impact_speed{};
  std::optional<double> people_touched{};
  std::optional<double> people_run_into{};
  std::optional<double> near_misses{};
  std::optional<double> noticed{};
  std::optional<double> found_again{};
  std::optional<double> sure_but_wrong{};
  std::optional<double> ambiguous{};
  std::optional<double> recoveries{};
  friend bool operator==(const Measures&, const Measures&) = default;
};

/// A measure: where it is kept, and what it means.
struct Measure {
  const char* name;  ///< The column's in tables; never changes.
  const char* unit;  ///< "" for a ratio.
  const char* text;
  std::optional<double> Measures::*value;
  const char* needs;                                      ///< Needed of a run for it, "a world with people".
  double most = std::numeric_limits<double>::infinity();  ///< None is greater, and none below 0.
};

/// Returns all measures, in the order of the columns.
[[nodiscard]] std::span<const Measure> all_measures();

/// The end of a run, without its motion.
struct RunEnd {
  bool succeeded = false;
  TimePoint end{};                                 ///< By the run's clock: the last arrival of a success.
  std::optional<TimePoint> first_contact{};        ///< By the same clock.
  bool lost = false;                               ///< A goal was claimed wrongly.
  bool overload = false;                           ///< A component computed longer than it may.
  std::optional<double> reference = std::nullopt;  ///< [m] Length of the way that the world names.
};

/// Measures the true motion of a run's robots.
/// @thread  no shared state; any thread.
[[nodiscard]] Measures measure(const Scene& scene, const RunEnd& end);

/// Returns why a run that was not ended by a fault did not succeed.
[[nodiscard]] Failure failure_in(const Scene& scene, const RunEnd& end);

/// The drawing of a run in a report: lists of lines, each the places that it joins, as "x y" [m] to 1 cm, with commas between the
/// places and semicolons between the lines. A plain value.
struct Sketch {
  std::string tracks{};    ///< Where each robot went: at most 129 evenly spaced places.
  std::string contacts{};  ///< Where robots touched something, each a line of one place: the first 8.
  std::string walls{};     ///< The world's, as it was at the end.
  friend bool operator==(const Sketch&, const Sketch&) = default;
};

[[nodiscard]] Sketch sketch_of(const Scene& scene);

}  // namespace orca::batch
