// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace orca::avoid {

/// A place from which an echo came, robot frame.
struct Echo {
  double x = 0.0;  ///< [m] ahead.
  double y = 0.0;  ///< [m] to the left.
};

/// How the robot has moved: where it is now in the frame in which it was.
struct Motion {
  double x = 0.0;    ///< [m] ahead.
  double y = 0.0;    ///< [m] to the left.
  double yaw = 0.0;  ///< [rad] counter-clockwise positive.
};

/// Where the echo of a range reading comes from: on the x axis of a sensor that is mounted at `mount` in the
/// robot frame, `range` [m] away. Below `min_range` the sensor cannot tell how near something is: it may be
/// at the sensor itself. Nothing at or above `max_range`, and for what is no number.
[[nodiscard]] std::optional<Echo> echo_of(double range, double min_range, double max_range,
                                          const Motion& mount);

/// The same place seen from where the robot is now.
[[nodiscard]] Echo seen_after(const Echo& echo, const Motion& motion);

/// The motion that leads from one pose to another, both given in one frame.
[[nodiscard]] Motion between(const Motion& from, const Motion& to);

/// The motion of a robot that drives and turns evenly for some time: an arc.
///
/// @param speed      [m/s] forward positive.
/// @param turn_rate  [rad/s] counter-clockwise positive.
/// @param time       [s] negative: where the robot was that long ago.
[[nodiscard]] Motion arc(double speed, double turn_rate, double time);

/// What was heard in the last seconds, carried along as the robot moves: a corner between two beams, or a
/// smooth wall that has turned its face away, is still there although nothing is heard of it now.
///
/// A single echo counts for a moment only, as a sonar also invents some. One that was heard near the same
/// place before is kept for longer.
///
/// Thread contract: not synchronised. Takes no memory after construction.
class EchoMemory {
 public:
  struct Limits {
    double confirmed_time = 0.0;  ///< [s] an echo that was heard at least twice is kept.
    double single_time = 0.0;     ///< [s] one that was heard once is kept.
    double same_place = 0.0;      ///< [m] echoes nearer to each other than this confirm each other.
    double range = 0.0;           ///< [m] from the robot's centre; where an echo from farther away came from
                                  ///< is too uncertain to keep it for longer.
  };

  EchoMemory();

  /// The robot has moved within `time` [s].
  void advance(const Motion& motion, double time, const Limits& limits);

  /// An echo from `echo`, seen from where the robot is now.
  void hear(const Echo& echo, const Limits& limits);

  /// Forgets the echoes that `unwanted` names.
  template <class Predicate>
  void forget_if(Predicate unwanted) {
    for (std::size_t i = echoes_.size(); i-- > 0;)
      if (unwanted(echoes_[i])) erase(i);
  }

  void clear();

  /// All that counts now, robot frame. Valid until the next change.
  [[nodiscard]] std::span<const Echo> echoes() const { return echoes_; }

 private:
  struct Trace {
    double age = 0.0;  // [s]
    bool confirmed = false;
  };
  void erase(std::size_t i);

  // Side by side, so that the echoes can be handed out as they are.
  std::vector<Echo> echoes_;
  std::vector<Trace> traces_;
};

}  // namespace orca::avoid
