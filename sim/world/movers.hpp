// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "motion/physics.hpp"
#include "motion/walker_track.hpp"
#include "orca/base/hash.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/sim/caster.hpp"
#include "orca/sim/readings.hpp"
#include "orca/sim/snapshot.hpp"
#include "orca/sim/world.hpp"
#include "robot.hpp"

namespace orca::sim::detail {

// The moving things that are not robots: walkers, and obstacles that are added, moved and removed while the
// world runs. Their numbers are those of Physics and are never used again.
class Movers {
 public:
  Movers(const WorldModel& world, std::uint64_t run_seed, Caster& caster, Physics& physics);

  // Adds an obstacle; `shape` is in its own frame, whose pose is `X_WO`. @return  its number.
  std::size_t add(const std::string& name, Shape shape, double height, const Pose2& X_WO,
                  Colour colour = kPlainColour);
  void move(std::size_t number, const Pose2& X_WO);
  void remove(std::size_t number);

  // Lets the walkers go in the tick that begins now, except those that stop for one of the robots.
  void set_off(Duration tick, const std::deque<Robot>& robots);
  // Notes how far they came. @pre  Physics has made its step.
  void arrive();

  // Returns true if there is an obstacle of that number; walkers are not obstacles.
  [[nodiscard]] bool is_obstacle(std::size_t number) const;
  [[nodiscard]] bool has_name(const std::string& name) const;
  [[nodiscard]] const std::string& name(std::size_t number) const { return movers_.at(number).name; }
  [[nodiscard]] std::size_t size() const { return movers_.size(); }
  // Returns what there is of an obstacle.
  [[nodiscard]] Standing obstacle(std::size_t number) const {
    const Mover& mover = movers_.at(number);
    return {mover.name, mover.shape, mover.pose, ObstacleId{number}};
  }
  // Returns the body that an obstacle would have at `X_WO`.
  [[nodiscard]] Body body_at(std::size_t number, const Pose2& X_WO) const;
  // Returns the name of a mover that overlaps `body` and is taller than `bottom` [m], or null.
  [[nodiscard]] const std::string* at(const Shape& body, double bottom) const;

  // Returns the speed [m/s] at which a walker set off in the last tick; nothing if it is an obstacle.
  [[nodiscard]] std::optional<double> walking_speed(std::size_t number) const;
  [[nodiscard]] std::vector<Person> people() const;

  void draw(Snapshot& snapshot) const;
  void add_to(Fnv1a& hash) const;

 private:
  struct Walk {
    WalkerTrack track;
    double stops = 0.0;  // [m]
    double speed = 0.0;  // [m/s]
    Duration walked{0};
    bool sets_off = false;  // In the present tick.
    double pace = 0.0;      // [m/s] At which it does.
    double yields = 0.0;    // Share of the room that it makes for others.
    Duration advance{0};    // By which it goes on along its track in the present tick, if nothing holds it.
    double legs = 0.0;      // [m] Diameter; 0: none.
    double way = 0.0;       // [m] It has gone, which tells how its legs stand.
    Vec2 ahead{1.0, 0.0};   // Unit vector, the direction of its track.
  };
  struct Mover {
    std::string name;
    Shape shape;
    double height = 0.0;
    Pose2 pose{};
    Colour colour = kPlainColour;
    std::size_t body = 0;  // Its number in the caster.
    bool present = true;
    std::optional<Walk> walk{};
    [[nodiscard]] Shape placed() const { return sim::placed(shape, pose); }
    [[nodiscard]] bool has_legs() const { return walk && walk->legs > 0.0; }
    // Returns its two legs. @pre  has_legs()
    [[nodiscard]] std::array<Circle, 2> legs() const;
    // Returns what sensors see of it. @pre  has_legs()
    [[nodiscard]] std::vector<Body> figure() const;
  };

  // Somebody whom a walker sees.
  struct Other {
    Vec2 position;
    double radius = 0.0;
  };

  [[nodiscard]] std::vector<Other> others(std::size_t number, const std::deque<Robot>& robots) const;
  [[nodiscard]] double wanted_aside(std::size_t number, const std::deque<Robot>& robots) const;
  [[nodiscard]] Vec2 next_step(Mover& mover, std::size_t number, Duration tick,
                               const std::deque<Robot>& robots) const;

  const WorldModel& world_;
  Caster& caster_;
  Physics& physics_;
  std::vector<Mover> movers_;
};

}  // namespace orca::sim::detail
