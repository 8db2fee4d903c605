// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <optional>
#include <string>

#include "orca/geometry/vec2.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/reporter.hpp"

namespace orca::hw {

/// The links of a robot's file and where they are when all joints stand at zero.
///
/// Thread contract: not synchronised.
class LinkTree {
 public:
  /// Reads the joints of a file. @param robot  its element <robot>. @param reporter  gets what is wrong; both outlive the object.
  LinkTree(const xml::Element& robot, xml::Reporter& reporter);

  /// Returns where a link is in the frame of the robot.
  [[nodiscard]] Eigen::Isometry3d place_of(std::string link) const;
  /// Reads a place, `xyz` and `rpy` of an element <origin>.
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

/// Returns the size of the rectangle around the origin that holds the plan of all collision geometry [m], as the simulator tells
/// it: 0 and 0 if a round part in the middle holds all others. Nothing if the file has none, or meshes, which it does not read.
/// @thread  pure function; any thread.
[[nodiscard]] std::optional<Vec2> plan_size(const xml::Element& robot, const LinkTree& tree);

}  // namespace orca::hw
