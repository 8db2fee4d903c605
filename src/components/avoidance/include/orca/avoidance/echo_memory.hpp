// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "orca/geometry/pose2.hpp"

namespace orca::avoid {

/// Returns the place from which an echo came, in the robot frame: `range` [m] along the x axis of the sensor
/// at `X_RS`. Below `min_range` the sensor cannot measure the distance: the obstacle may be at the sensor
/// itself. Returns nothing at or above `max_range`, and if `range` or the pose is not a number.
[[nodiscard]] std::optional<Vec2> echo_of(double range, double min_range, double max_range,
                                          const Pose2& X_RS);

/// The echoes of the last seconds, carried along as the robot moves. A corner between two beams, or a smooth
/// wall that has turned its face away, is still there although the sensor no longer hears it.
///
/// A single echo counts for a moment only, because a sonar also reports false ones. An echo that was heard
/// near the same place before is kept for longer.
///
/// Sensors that hear different things, because one looks over what another one sees, each have echoes of their own: none of
/// them moves, confirms or forgets those of another.
///
/// Thread contract: not synchronised. Allocates nothing after construction for up to four sensors.
class EchoMemory {
 public:
  struct Limits {
    double confirmed_time = 0.0;  ///< [s] an echo that was heard at least twice is kept.
    double single_time = 0.0;     ///< [s] one that was heard once is kept.
    double same_place = 0.0;      ///< [m] echoes nearer to each other than this confirm each other.
    double range = 0.0;           ///< [m] from the robot's centre; where an echo from farther away came from
                                  ///< is too uncertain to keep it for longer.
    double no_news = 0.04;        ///< [m] an echo this near to a known one moves it, and adds none.
    bool hidden = false;          ///< Whether a scan leaves echoes that lie behind what it sees.
    std::uint32_t sensor = 0;     ///< Which of the robot's sensors hears.
  };

  EchoMemory();

  /// Moves the echoes into the robot's new frame, and forgets those that are too old.
  /// @param X_RN  new robot frame in the former one.
  /// @param time [s]  between the two.
  void advance(const Pose2& X_RN, double time, const Limits& limits);

  /// Adds an echo, given in the robot frame.
  void hear(Vec2 echo, const Limits& limits);

  /// Forgets the echoes of a sensor for which `unwanted(echo)` is true.
  template <class Predicate>
  void forget_if(std::uint32_t sensor, Predicate unwanted) {
    for (std::size_t i = echoes_.size(); i-- > 0;)
      if (traces_[i].sensor == sensor && unwanted(echoes_[i])) erase(i);
  }

  void clear();

  /// Returns all echoes that count now, robot frame. Valid until the next change.
  [[nodiscard]] std::span<const Vec2> echoes() const { return echoes_; }

  /// Returns whether `echoes()[i]` was heard at least twice.
  [[nodiscard]] bool is_confirmed(std::size_t i) const { return traces_[i].confirmed; }

  /// Returns how sure it is that something is still at `echoes()[i]`: 1 when it was just heard, falling evenly to 0
  /// when it will be forgotten.
  [[nodiscard]] double certainty(std::size_t i, const Limits& limits) const;

  /// Returns all of it, to be passed on.
  auto state() { return std::tie(echoes_, traces_); }

 private:
  struct Trace {
    double age = 0.0;  // [s]
    bool confirmed = false;
    std::uint32_t sensor = 0;
  };
  static double kept_for(const Trace& trace, const Limits& limits);
  void make_room(std::uint32_t sensor);
  void erase(std::size_t i);

  // Side by side, so that the echoes can be handed out as they are.
  std::vector<Vec2> echoes_;
  std::vector<Trace> traces_;
};

}  // namespace orca::avoid
