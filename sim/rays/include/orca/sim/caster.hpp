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

/// A ray in the horizontal plane at a certain height above the floor.
struct Ray {
  Vec2 origin;
  Vec2 direction;              ///< Of length 1.
  double max_range = 0.0;      ///< [m] Nothing farther is reported.
  double sensor_height = 0.0;  ///< [m] Above the floor: only what is solid there is seen.
  std::size_t ignore_body =
      static_cast<std::size_t>(-1);  ///< A moving body that is not seen: the sensor's own.
};

/// The boundary element a ray met: nothing, an edge or a circle, as it lies in the world now.
using Surface = std::variant<std::monostate, Segment, Circle>;

/// What a ray met first.
struct Hit {
  double range = 0.0;  ///< [m] Distance along the ray; max_range if nothing was met.
  Surface surface;
  /// Which boundary element of the world that is, wherever it has moved meanwhile; all meshes count as one.
  /// 0: nothing was met.
  std::uint64_t element = 0;
  Vec2 point;      ///< Where the ray ends.
  Vec2 direction;  ///< Of the ray.
  [[nodiscard]] bool found() const { return surface.index() != 0; }
  /// Angle between ray and surface normal, 0 (head on) to pi/2 (grazing) [rad]. @pre  found()
  [[nodiscard]] double incidence() const;
  /// Whether the tangent of incidence() is at most `tangent`. @pre  found()
  [[nodiscard]] bool steeper_than(double tangent) const;

 private:
  [[nodiscard]] Vec2 along() const;  // The surface, where it was met; of any length.
};

/// Something upright that can be seen and can come, move and go: a robot, a person, a box put down.
struct Body {
  Shape shape;          ///< In the world frame, at its present pose.
  double bottom = 0.0;  ///< [m] Lowest point above the floor: a sensor as high as this sees it.
  double top = 0.0;     ///< [m] Highest point above the floor: a sensor as high as this does not.
};

/// Exact ray casting against a world and the bodies in it, in closed form on a uniform grid.
///
/// A boundary is met from either side. It catches rays that pass an end of an edge, or start beyond it,
/// by less than 1 nm, so that no ray slips through a corner that two edges share; the edges of solids are
/// closed, so an edge parallel to the ray may be left to its neighbours. (Bullet's own ray test is off by
/// more than 1 cm for some 4 % of rays on boxes and is not used.)
///
/// Thread contract: cast() from many threads; add_body, move_body and remove_body need exclusive access.
class Caster {
 public:
  explicit Caster(const WorldModel& world);
  ~Caster();
  Caster(Caster&&) noexcept;
  Caster& operator=(Caster&&) noexcept;

  /// @return  the number of the new body, counting from 0; numbers are not used again.
  std::size_t add_body(Body body);

  /// @pre  `number` came from add_body.
  void move_body(std::size_t number, Shape shape);

  /// The body is not seen any more, whatever is done with it. @pre  `number` came from add_body.
  void remove_body(std::size_t number);

  /// The first thing on the ray's way.
  [[nodiscard]] Hit cast(const Ray& ray) const;

  class View;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What many rays from about one place in about one direction may meet, looked for once: the same as casting
/// each by itself, and faster. It holds until a body is added, moved or removed, and not longer than the
/// caster lives; then it may look again.
///
/// Thread contract: as of Caster's cast(); look() needs exclusive access to the view.
class Caster::View {
 public:
  View() = default;
  /// One that looks at once.
  View(const Caster& caster, const Ray& axis, double half_angle, double slack = 0.0);

  /// @param axis        where rays start, how far they go, at what height, and whose body they do not see.
  /// @param half_angle  [rad] Between the axis and any ray.
  /// @param slack       [m] Between the axis' origin and that of any ray.
  void look(const Caster& caster, const Ray& axis, double half_angle, double slack = 0.0);

  /// The first thing on the ray's way. @pre  it has looked, and the ray is as the axis, but for what was said
  /// of angle and slack.
  [[nodiscard]] Hit cast(const Ray& ray) const;

 private:
  const Impl* impl_ = nullptr;
  double empty_to_ = 0.0;  // [m] Nothing that stands is nearer.
  bool chosen_ = false;
  std::vector<std::uint32_t> bodies_;  // If they are chosen; else it is all.
};

}  // namespace orca::sim
