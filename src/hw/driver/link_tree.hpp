// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <functional>
#include <map>
#include <string>
#include <string_view>

#include "orca/xml/document.hpp"

namespace orca::hw {

/// Returns the first child of that name; null: there is none.
[[nodiscard]] const xml::Element* child_of(const xml::Element& parent, std::string_view name);
/// Returns the value of an attribute; empty without it.
[[nodiscard]] std::string text_of(const xml::Element& e, std::string_view name);

/// The links of a robot's file and where they are when all joints stand at zero.
///
/// Thread contract: not synchronised.
class LinkTree {
 public:
  /// Gets what is wrong, and where.
  using Complain = std::function<void(const xml::Element& at, const std::string& what)>;

  /// Reads the joints of a file. @param robot  its element <robot>, which outlives the object.
  LinkTree(const xml::Element& robot, Complain complain);

  /// Returns where a link is in the frame of the robot.
  [[nodiscard]] Eigen::Isometry3d place_of(std::string link) const;
  /// Reads a place, `xyz` and `rpy` of an element <origin>.
  [[nodiscard]] Eigen::Isometry3d origin(const xml::Element& e) const;
  /// Reads three numbers; zeros where the attribute is missing.
  [[nodiscard]] std::array<double, 3> three(const xml::Element& e, const char* name) const;

 private:
  struct Joint {
    std::string parent;
    Eigen::Isometry3d place;
  };

  const Complain complain_;
  std::map<std::string, Joint> joints_;  // by the link below
};

}  // namespace orca::hw
