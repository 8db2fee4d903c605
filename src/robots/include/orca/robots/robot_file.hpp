// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/robots/characteristics.hpp"
#include "orca/xml/attributes.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::robots {

/// The shortest period that a device of a robot file may have: the tick of the simulation.
inline constexpr Duration kShortestPeriod = std::chrono::milliseconds(10);

/// What a reader of robot files adds if it needs the solid body: the simulator.
///
/// Thread contract: that of the call of read_robot() that it is given to.
class BodyReader {
 public:
  virtual ~BodyReader() = default;

  /// Returns the corners of the convex hull of a mesh, not scaled.
  /// @param path  a mesh file that is named as collision geometry.
  /// @errors  those of reading it; they are reported at the place that names it.
  [[nodiscard]] virtual Result<std::vector<Vec3>> hull_of(const std::string& path) = 0;

  /// Checks the solid body, and reports what is wrong.
  /// @param robot      its body, drive and devices; where the devices sit is not known yet.
  /// @param extension  the element <orca>.
  virtual void check(const Characteristics& robot, const xml::Attributes& extension) = 0;

  /// Checks the parts that turn with the turret. @pre  the robot has one, whose axis is known.
  /// @param turret  the element <turret>.
  virtual void check_turret(const Characteristics& robot, const xml::Attributes& turret) = 0;
};

/// Reads a robot: a URDF file with one <orca> element inside <robot> (docs/robot-files.md). The URDF's root
/// link is the base frame, on the floor; moving joints stand at zero.
///
/// @param diagnostics  receives all errors at once, each with file, line and column (codes R001 ...).
/// @param body         reads meshes and checks the body; null: hulls of meshes have no corners.
/// @return nothing if there was any error.
[[nodiscard]] std::optional<Characteristics> read_robot(const std::string& path,
                                                        xml::Diagnostics& diagnostics,
                                                        BodyReader* body = nullptr);

/// Reads a robot from text in memory; `file_name` only appears in positions.
[[nodiscard]] std::optional<Characteristics> read_robot_text(std::string_view text,
                                                             const std::string& file_name,
                                                             xml::Diagnostics& diagnostics,
                                                             BodyReader* body = nullptr);

}  // namespace orca::robots
