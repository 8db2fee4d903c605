// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/vec2.hpp"
#include "orca/sim/event.hpp"
#include "orca/sim/floor.hpp"
#include "orca/sim/mesh.hpp"

namespace orca::sim {

/// A person as an upright cylinder, for sensors on two legs if it has some, that walks along a track of straight legs for ever.
///
/// Its place depends only on the time and the seed, unless it stops for robots or steps aside. It pushes robots that
/// are in its way.
struct Walker {
  std::string name;           ///< Name that contacts report.
  std::vector<Vec2> track{};  ///< Corners, at least two.
  double radius = 0.25;       ///< [m]
  double height = 1.7;        ///< [m]
  double speed = 1.0;         ///< [m/s]
  bool round = false;  ///< True: straight from the last corner to the first; false: back along the track.
  Duration pause{0};   ///< Longest rest at a corner; each rest is drawn between 0 and this.
  std::optional<Duration> start{};      ///< Time on its round at time 0; drawn if not given.
  std::optional<std::uint64_t> seed{};  ///< Seed of the drawn values; the run's seed if not given.
  /// [m] It stands still while a robot is nearer than this ahead of it; 0: it stops for no robot.
  double stops = 0.0;
  /// Share of the room that it makes, by stepping aside, for a robot or another walker ahead of it: 0 it walks straight on, 1 it
  /// makes all of the room. Robots and other walkers may make the rest.
  double yields = 0.0;
  /// [m] Diameter of its legs; 0: it has none. Then sensors see the cylinder at all heights; otherwise below half of its height two
  /// legs within the cylinder, which swing as it walks. Robots touch the cylinder all the same.
  double legs = 0.0;
  Colour colour = kClothes;  ///< What cameras see of it.
  static constexpr double kHip =
      0.4;  ///< Distance of each leg from the middle, to its side, as a share of the radius.
};

/// What a surface does to the light of a laser. Cameras see it, too: a black one is black, glass is pale. Sonars, infrared sensors and
/// bumpers do not tell them apart.
enum class Finish : std::uint8_t {
  plain,  ///< It scatters half of the light.
  black,  ///< It scatters 2.4 % of it.
  glass   ///< It returns light that meets it head on, as a plain one does; other light goes through.
};
/// Their names, in the same order.
inline constexpr std::array<std::string_view, 3> kFinishes{"plain", "black", "glass"};

/// A solid that never moves: an upright body over its plan.
struct Obstacle {
  std::string name;     ///< For people, e.g. "wall" or "desk_2"; need not be unique.
  Shape shape;          ///< Its plan, in the world frame.
  double height = 0.0;  ///< [m] Its top above the floor; a sensor at this height or higher does not see it.
  double bottom = 0.0;  ///< [m] Its underside above the floor, e.g. of a table top; 0: it is on the floor.
  /// The mesh in the world frame, if the obstacle has one. Then only the mesh is solid: `shape` is its convex
  /// hull seen from above, and it lies between `bottom` and `height`. The mesh is shared, because models are
  /// copied and meshes are large.
  std::shared_ptr<const Mesh> mesh{};
  Finish finish = Finish::plain;  ///< Of all its sides; a mesh is plain.
};

/// Returns an obstacle of a mesh that is given in the world frame. @pre  the mesh has triangles.
[[nodiscard]] Obstacle mesh_obstacle(std::string name, Mesh mesh);

/// Returns true if the obstacle shares a point with the upright body over `plan` between `bottom` and `top`
/// [m].
[[nodiscard]] bool overlap(const Obstacle& obstacle, const Shape& plan, double bottom, double top);

/// A named pose, e.g. the start or the goal of a robot.
struct Place {
  std::string name;
  Pose2 pose;
};

/// A place where the batteries of robots are charged that rest there.
struct Charger {
  std::string place;  ///< Name of the place.
  Pose2 pose{};
  double reach = 0.0;  ///< [m] How far the middle of a robot, or its front, may be from there.
  /// Whether a robot must bring its foremost point there, looking in the direction of the place to within kAskew.
  bool at_front = false;
  static constexpr double kAskew = 0.1745;  ///< [rad] 10 degrees.
};

/// The leaf of a door, which swings or slides. It is shut or open, or on its way from one to the other. People open it.
struct Door {
  std::string name;  ///< Name that contacts report; not that of another door, a walker or a visitor.
  Segment shut{};    ///< The shut leaf, from its hinges, or from where it slides to, to its free edge.
  bool slides = false;
  double swing =
      0.0;  ///< [rad] The open leaf of a door that swings is turned so far, counter-clockwise positive.
  bool open = false;       ///< At first.
  double thickness = 0.0;  ///< [m]
  double height = 0.0;     ///< [m]
  /// It shuts itself so long after the last person has gone; nothing: it stays open.
  std::optional<Duration> closer{};
};

/// A thing that a gripper can carry: an upright cylinder that stands on the floor.
struct Item {
  std::string name;     ///< Name that contacts report; not that of another item or of a walker.
  double radius = 0.0;  ///< [m]
  double height = 0.0;  ///< [m]
  Pose2 pose;           ///< Where it stands at first, in the world frame.
};

/// A world without robots: a plan with heights (2.5-D), named places, people who walk about, things to carry, chargers, doors, and
/// what happens in it. A plain value.
struct WorldModel {
  std::string name;
  std::vector<Obstacle> obstacles;
  std::vector<Place> places;
  std::vector<Walker> walkers{};
  Floor floor{};
  Events events{};
  std::vector<Item> items{};
  std::vector<Charger> chargers{};
  std::vector<Door> doors{};

  /// Returns the place of that name, or null.
  [[nodiscard]] const Place* place(std::string_view name) const;

  /// Returns the rectangle that holds all obstacles and places.
  [[nodiscard]] Bounds bounds() const;

  /// Returns the first obstacle that shares a point with the upright body over `body` between `bottom` and
  /// `top` [m], or null.
  [[nodiscard]] const Obstacle* obstacle_at(const Shape& body, double bottom,
                                            double top = std::numeric_limits<double>::infinity()) const;
};

}  // namespace orca::sim
