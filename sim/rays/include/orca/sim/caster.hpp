// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

#include "orca/geometry/vec2.hpp"
#include "orca/sim/world_model.hpp"

namespace orca::sim {

namespace detail {
class Panorama;
}

/// A ray in the horizontal plane at a certain height above the floor.
struct Ray {
  Vec2 origin;
  Vec2 direction;              ///< Unit vector.
  double max_range = 0.0;      ///< [m] Nothing farther is reported.
  double sensor_height = 0.0;  ///< [m] Height above the floor; only things solid at this height are met.
  /// Number of the body that the ray passes through: the sensor's own. The default ignores none.
  std::size_t ignore_body = static_cast<std::size_t>(-1);
};

/// The boundary element that a ray met: nothing, an edge or a circle, in its present place in the world.
using Surface = std::variant<std::monostate, Segment, Circle>;

/// The first thing that a ray met.
struct Hit {
  double range = 0.0;  ///< [m] Distance along the ray; max_range if nothing was met.
  Surface surface;
  /// Number of that boundary element. It stays the same when the element moves; all meshes share one number.
  /// 0: nothing was met.
  std::uint64_t element = 0;
  Vec2 point;                     ///< End of the ray, in the world frame.
  Vec2 direction;                 ///< The ray's direction, a unit vector.
  Finish finish = Finish::plain;  ///< Of what was met; bodies and meshes are plain.
  [[nodiscard]] bool found() const { return surface.index() != 0; }
  /// Returns the angle between ray and surface normal, 0 (head on) to pi/2 (grazing) [rad]. @pre  found()
  [[nodiscard]] double incidence() const;
  /// Returns the cosine of incidence(), for less. @pre  found()
  [[nodiscard]] double cosine() const;
  /// Returns true if the tangent of incidence() is at most `tangent`. @pre  found()
  [[nodiscard]] bool steeper_than(double tangent) const;

 private:
  [[nodiscard]] Vec2 along() const;  // Returns the surface's tangent at `point`, of any length.
};

/// An upright solid that sensors see and that may be added, moved and removed: a person, a box, a part of a robot.
struct Body {
  Shape shape;          ///< Shape in the world frame, at the present pose.
  double bottom = 0.0;  ///< [m] Lowest point above the floor: a sensor at exactly this height sees the body.
  double top = 0.0;     ///< [m] Highest point above the floor: a sensor at exactly this height does not.
  Colour colour = kPlainColour;  ///< What cameras see; of several solids that of the first counts.
};

/// A ray caster for a world and the bodies in it: exact, in closed form, on a uniform grid.
///
/// A ray meets a boundary from either side. An edge also catches rays that pass one of its ends, or start
/// beyond it, by less than 1 nm, so that no ray slips through a corner that two edges share. The edges of a
/// solid are closed, so an edge parallel to the ray may be left to its neighbours. (Bullet's own ray test is
/// off by more than 1 cm for some 4 % of rays on boxes and is not used.)
///
/// Thread contract: const functions from many threads; the others need exclusive access.
class Caster {
 public:
  explicit Caster(const WorldModel& world);
  ~Caster();
  Caster(Caster&&) noexcept;
  Caster& operator=(Caster&&) noexcept;

  /// Adds a body. @return  its number, counting from 0; numbers are not used again.
  std::size_t add_body(Body body);

  /// Adds a body of several upright solids, which may stand in each other. At each height it has the outline of those
  /// that reach there. @return  as add_body(). @pre  `solids` is not empty.
  std::size_t add_solids(std::vector<Body> solids);

  /// Gives the body, or its first solid, a new shape in the world frame. @pre  `number` came from add_body.
  void move_body(std::size_t number, Shape shape);

  /// Gives the body other solids. @pre  `number` came from add_body or add_solids, and `solids` is not empty.
  void move_solids(std::size_t number, std::vector<Body> solids);

  /// Hides the body from all later casts, even if it is moved afterwards. @pre  `number` came from add_body.
  void remove_body(std::size_t number);

  /// Returns the first thing that the ray meets.
  [[nodiscard]] Hit cast(const Ray& ray) const;

  /// Finds everything that is seen in a cone, exactly. The cone opens as far up and down as to both sides. Of a mesh
  /// only the section at the sensor's height is seen.
  ///
  /// @param axis        middle ray of the cone: gives the origin, range, sensor height and ignored body.
  /// @param half_angle  [rad] angle between the axis and the rims, at most a right angle.
  /// @param view        receives the result; what it held is lost.
  void survey(const Ray& axis, double half_angle, detail::Panorama& view) const;

  /// Returns the colour of what a ray met. @pre  hit.found(), of a ray since the last change.
  [[nodiscard]] Colour colour_of(const Hit& hit) const;

  /// Returns the heights [m] between which everything is upright, in ascending order: rays at two heights between neighbouring ones meet
  /// the same. Meshes, which are not upright, are cut every 0.1 m.
  [[nodiscard]] std::vector<double> heights() const;

  class View;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A selection of what rays from about one place in about one direction may meet.
///
/// Casting through a view gives the same results as Caster::cast() and is faster, because the search is done
/// once for all rays. A view is valid until a body is added, moved or removed; then look() must be called
/// again. The caster must outlive it.
///
/// Thread contract: cast() from many threads; look() needs exclusive access to the view.
class Caster::View {
 public:
  View() = default;
  /// Calls look() with the same arguments.
  View(const Caster& caster, const Ray& axis, double half_angle, double slack = 0.0);

  /// Selects what the rays of a cone may meet.
  ///
  /// @param axis        middle ray of the cone: gives the origin, range, sensor height and ignored body.
  /// @param half_angle  [rad] largest angle between the axis and any ray.
  /// @param slack       [m] largest distance between the axis' origin and that of any ray.
  void look(const Caster& caster, const Ray& axis, double half_angle, double slack = 0.0);

  /// Returns the first thing that the ray meets.
  /// @pre  look() was called, and the ray equals its axis but for an angle within `half_angle` and an origin
  ///       within `slack`.
  [[nodiscard]] Hit cast(const Ray& ray) const;

 private:
  const Impl* impl_ = nullptr;
  double empty_to_ = 0.0;              // [m] No standing thing is nearer than this.
  bool chosen_ = false;                // False: rays look at all bodies.
  std::vector<std::uint32_t> bodies_;  // Numbers of the chosen bodies.
};

}  // namespace orca::sim
