// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "orca/avoidance/echo_memory.hpp"
#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"

namespace orca::avoid {

/// Checks when a sensor of a ring has measured last. A base reports its ring even if the sensors are off. A driver that does not know
/// which sensor has measured takes a range that stays the same for a round old.
/// @param age       [s] since then; negative: it was measured later than now.
/// @param most      [s] that a reading may have.
/// @param one       a sensor, for people: "sonar".
/// @param has_done  the deed of one, done: "fired".
/// @errors  invalid_argument.
/// @thread  pure function; any thread.
[[nodiscard]] inline Status check_firing(double age, double most, const std::string& one,
                                         const std::string& has_done) {
  constexpr double kRound = 0.5;  // [s] in which the slowest known ring measures once
  if (age <= most + kRound) return check_age(age, most + kRound);
  return fail(Code::invalid_argument, "no " + one + " has " + has_done + " for " + std::to_string(age) +
                                          " s; are the " + one + "s off?");
}

/// The ear for one ring of sonars, or of infrared sensors: it takes each firing once. A base reports its whole ring more often than the ring makes its
/// round, and a repeated echo would confirm itself, each time at another place, as the motion since it was heard is a guess.
///
/// A sonar's echo may come from anywhere on the arc of the cone; the middle of the arc is used. An obstacle below the minimum range
/// may be at the sonar itself.
///
/// Thread contract: as for a container.
class RingEar {
 public:
  /// Calls `note(echo, fired)` for each echo of a sonar that has fired since the last round: its place in the robot frame of that
  /// moment [m], and when that was.
  /// @param now      the moment of firings without a stamp.
  /// @param repeats  whether firings that were reported before count again.
  /// @tparam Round  SonarRangeReadings or InfraredRangeReadings.
  template <class Round, class Note>
  void take(const Round& round, TimePoint now, bool repeats, Note note) {
    const std::size_t count = std::min(round.ranges().size(), round.poses().size());
    fired_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const TimePoint fired = i < round.stamps().size() ? to_time_point(round.stamps()[i]) : now;
      const bool is_news = fired_[i] != fired;
      fired_[i] = fired;
      if (!is_news && !repeats) continue;
      const auto echo =
          echo_of(round.ranges()[i], round.min_range(), round.max_range(), plane_pose(round.poses()[i]));
      if (echo) note(*echo, fired);
    }
  }
  /// Returns when a sonar of the round has fired last; nothing if they have no stamps.
  template <class Round>
  [[nodiscard]] static std::optional<TimePoint> last_firing(const Round& round) {
    std::optional<TimePoint> last;
    for (const idl::TimeValue& stamp : round.stamps())
      last = std::max(last, std::optional(to_time_point(stamp)));
    return last;
  }
  void clear() { fired_.clear(); }

 private:
  std::vector<std::optional<TimePoint>> fired_;  // by sonar: the stamp of its last reading
};

}  // namespace orca::avoid
