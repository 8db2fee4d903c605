// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "movers.hpp"
#include "orca/base/hash.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/sim/readings.hpp"
#include "orca/sim/snapshot.hpp"
#include "orca/sim/world_model.hpp"
#include "robot.hpp"

namespace orca::sim::detail {

// The items of a running world, and what grippers do with them. An item on the floor is a mover. One that a robot holds is
// none, so nothing sees or touches it, and it is where the gripper is.
class Items {
 public:
  // Puts the items of the world on the floor. All three must outlive this.
  Items(const WorldModel& world, std::deque<Robot>& robots, Movers& movers);

  // Moves the grippers for one tick, in the order of the robots, and notes in words what they take and let go.
  void handle(Duration tick, std::vector<std::string>& notes);

  // Returns the state of a robot's gripper. @pre  it has one.
  [[nodiscard]] GripperReading reading(std::size_t robot, TimePoint now) const;
  // Returns the pose of the item of that name in the world, on the floor or in a gripper; nothing if there is none.
  [[nodiscard]] std::optional<Pose2> pose(std::string_view name) const;
  // Returns whether the mover of that number is an item on the floor.
  [[nodiscard]] bool is_mover(std::size_t number) const;

  // Draws what is held; movers draw the others.
  void draw(Snapshot& snapshot) const;
  void add_to(Fnv1a& hash) const;

 private:
  struct Grasp {
    std::size_t robot = 0;
    double ahead = 0.0;  // [m] Place of the item's centre on the gripper's x axis.
  };
  struct Thing {
    Item item;
    Pose2 pose{};           // On the floor, if nobody holds it.
    std::size_t mover = 0;  // Its number, if nobody holds it.
    std::optional<Grasp> in{};
    [[nodiscard]] double width() const { return 2.0 * item.radius; }
    [[nodiscard]] Circle plan() const { return {{}, item.radius}; }
  };

  [[nodiscard]] Pose2 gripper_pose(std::size_t robot) const;
  [[nodiscard]] Pose2 pose(const Thing& thing) const;
  // Returns what closing paddles of the robot would hold first, or null.
  [[nodiscard]] Thing* between_paddles(std::size_t robot);
  [[nodiscard]] bool interrupts_beam(const Thing& thing, std::size_t robot, double share) const;
  // Returns the name of what the item would stand in, with its kind; empty if the place is free.
  [[nodiscard]] std::string in_the_way(const Thing& thing, const Pose2& X_WI) const;
  void take(Thing& thing, std::size_t robot);
  // Puts what the robot holds on the floor, if there is room. @pre  it holds something. @return  what to note.
  [[nodiscard]] std::string let_go(std::size_t robot);

  const WorldModel& world_;
  std::deque<Robot>& robots_;
  Movers& movers_;
  std::vector<Thing> things_;
};

// Returns a position for messages, in whole centimetres: "(3.10, 6.02) m".
inline std::string text(const Pose2& pose) {
  const auto number = [](double v) {
    std::string s = std::to_string(v);
    return s.substr(0, s.find('.') + 3);
  };
  return "(" + number(pose.x) + ", " + number(pose.y) + ") m";
}

}  // namespace orca::sim::detail
