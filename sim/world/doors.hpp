// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/sim/world.hpp"

namespace orca::sim::detail {

// Returns where the middle of a leaf is that is open by a share of its way.
[[nodiscard]] Pose2 pose_at(const Door& door, double share);

// The doors of a running world. A leaf opens for people who come to it and when the world's events say so; it stops at a robot that is in
// its way, and goes on as soon as that has gone.
class Doors {
 public:
  // @param seed  of the times that are drawn.
  Doors(const WorldModel& world, std::uint64_t seed);

  // Lets the leaves move for one tick, and notes in words which begin to open or to shut.
  void work(World& world, std::vector<std::string>& notes);

  // As doors_in().
  [[nodiscard]] std::vector<DoorState> states() const;
  // As turn_door().
  Status turn(const World& world, std::string_view name, bool opens);

 private:
  struct Leaf {
    const Door* door;
    bool opens;                      // Whether it is open, or on its way to be.
    double share;                    // Of the way from shut to open: 0 it is shut.
    std::optional<ObstacleId> id{};  // Nothing: a robot stands where it is to be.
    TimePoint left{};                // When the last person was there.
    bool by_people = false;          // Whether people have opened it.
  };
  struct Turn {
    Leaf* leaf;
    bool opens;
    TimePoint at;
  };

  static bool turn(Leaf& leaf, bool opens);
  static void turn(Leaf& leaf, bool opens, std::vector<std::string>& notes);
  static void follow_people(Leaf& leaf, const World& world, std::vector<std::string>& notes);
  static void move(Leaf& leaf, World& world);

  std::deque<Leaf> leaves_;
  std::vector<Turn> turns_;  // Those to come, by time, the last first.
};

}  // namespace orca::sim::detail
