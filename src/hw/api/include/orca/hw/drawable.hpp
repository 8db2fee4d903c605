// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca {
struct Scene;
}

namespace orca::hw {

/// Hardware that can be drawn, because it is simulated: nothing tells where a real robot truly was. A container that can
/// do so also derives from this, and returns itself from HardwareContainer::drawable().
///
/// Thread contract: both functions while the container's strand does not run.
class Drawable {
 public:
  /// Keeps from now on what draw() needs of the course of the run. Without this draw() adds the walls and where the
  /// robot ended, and no memory is spent meanwhile.
  /// @pre  called before the container is opened.
  virtual void keep_moments() = 0;

  /// Adds the world, unless another robot of the same world has done so, and the robot.
  /// @pre  the container's strand has ended.
  virtual void draw(Scene& scene) = 0;

 protected:
  Drawable() = default;
  ~Drawable() = default;
};

}  // namespace orca::hw
