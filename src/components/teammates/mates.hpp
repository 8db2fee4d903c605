// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/idl/moving.hpp"

namespace orca::team {

/// The other robots of a team, as one of them has heard of them.
///
/// Thread contract: as for a container.
class Mates {
 public:
  static constexpr std::size_t kMost = 64;  ///< More robots are not noted.

  /// Where this robot is.
  struct Here {
    std::string name;
    std::string map;
    Pose2 X_OM;              ///< The map's pose in the frame of the odometry.
    double place_error = 0;  ///< [m] Standard deviation of this robot's position in the map.
  };

  /// Notes what a robot says of itself.
  void hear(const idl::Teammate& mate, TimePoint now);
  /// Forgets whoever has said nothing for that long.
  void forget(TimePoint now, Duration lost_after);
  void clear() { mates_.clear(); }

  /// Returns the names of all that are known.
  [[nodiscard]] std::vector<std::string> names() const;

  /// Adds the robots that this one lets pass, as they are at an instant if they have gone on. If two robots know of each other,
  /// the one whose name comes first in the alphabet has the right of way: the other one lets it pass. A robot that does not know of this
  /// one, or does not say so, is always let pass. Robots of another map are left out.
  void add(const Here& here, TimePoint at, idl::MovingThings& moving) const;

 private:
  struct Mate {
    std::uint32_t number = 0;
    std::string name;
    TimePoint stamp{};
    TimePoint heard{};
    std::string map;
    Vec2 place;     // [m] in the map, as the next
    Vec2 velocity;  // [m/s]
    double radius = 0.0;
    double place_error = 0.0;
    std::vector<std::string> hears;
  };

  [[nodiscard]] static bool lets_pass(const Mate& mate, const Here& here);

  std::map<std::string, Mate> mates_;  // by origin: two may have taken one name
  std::uint32_t last_number_ = 0;
};

}  // namespace orca::team
