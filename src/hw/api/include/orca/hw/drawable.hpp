// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace orca {
struct Scene;
}

namespace orca::hw {

/// Hardware that can be drawn because it is simulated; the true pose of a real robot is not known. A
/// container that can be drawn also derives from this class, and returns itself from
/// HardwareContainer::drawable().
///
/// Thread contract: all functions only while the container's strand does not run.
class Drawable {
 public:
  /// Starts to record the parts of the run that draw() needs. Without this call draw() adds only the walls
  /// and the robot's final pose, and the run uses no memory for records.
  /// @pre  called before the container is opened.
  virtual void keep_moments() = 0;

  /// Starts to record the true motion, for measures of a run. A step takes 64 bytes, and there are ten a second.
  /// @pre  called before the container is opened.
  virtual void keep_motion() = 0;

  /// Adds the world, unless another robot of the same world has done so, and the robot. Before it is opened: only the world's
  /// places, and the robot where it starts.
  /// @pre  the container's strand has ended.
  virtual void draw(Scene& scene) = 0;

 protected:
  Drawable() = default;
  ~Drawable() = default;
};

}  // namespace orca::hw
