// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "orca/geometry/vec2.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/reporter.hpp"

namespace orca::robot_file {

/// The links of a robot's file and where they are when all joints stand at zero.
///
/// Thread contract: not synchronised.
class LinkTree {
 public:
  /// Reads the joints of a file. @param robot  its element `<robot>`. @param reporter  gets what is wrong; both outlive the object.
  LinkTree(const xml::Element& robot, xml::Reporter& reporter);

  /// Returns where a link is in the frame of the robot.
  [[nodiscard]] Eigen::Isometry3d place_of(std::string link) const;
  /// Reads a place, `xyz` and `rpy` of an element `<origin>`.
  [[nodiscard]] Eigen::Isometry3d origin(const xml::Element& e) const;
  /// Reads three numbers; zeros where the attribute is missing or wrong.
  [[nodiscard]] std::array<double, 3> three(const xml::Element& e, const char* name) const;

 private:
  struct Joint {
    std::string parent;
    Eigen::Isometry3d place;
  };

  xml::Reporter& reporter_;
  std::map<std::string, Joint> joints_;  // by the link below
};

/// A solid part of a robot's body: the upright prism that holds it, in the frame of the robot.
struct BodyPart {
  std::vector<Vec2>
      corners;  ///< [m] of its convex plan, counter-clockwise; a single one is the middle of a circle.
  double radius = 0.0;  ///< [m] of that circle.
  double bottom = 0.0;  ///< [m] above the floor.
  double top = 0.0;     ///< [m] above the floor.
};

/// Reads all collision geometry of a file. Nothing if it has meshes, which are not read here.
/// @thread  pure function; any thread.
[[nodiscard]] std::optional<std::vector<BodyPart>> body_parts(const xml::Element& robot,
                                                              const LinkTree& tree);

/// Returns the size of the rectangle around the origin that holds the plan of all parts [m], as the simulator computes it: 0 and 0 if a round
/// part in the middle holds all others, or if there is none.
/// @thread  pure function; any thread.
[[nodiscard]] Vec2 plan_size(const std::vector<BodyPart>& parts);

}  // namespace orca::robot_file
