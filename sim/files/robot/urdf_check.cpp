// SPDX-License-Identifier: LGPL-3.0-or-later
#include "urdf_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "files/formats/mesh_place.hpp"
#include "motion/hull_corners.hpp"
#include "orca/base/text.hpp"
#include "orca/robot_file/values.hpp"
#include "orca/xml/attributes.hpp"

namespace orca::sim::detail {
namespace {

class UrdfChecker {
 public:
  UrdfChecker(const std::string& packages, xml::Reporter& reporter, MeshHulls& hulls)
      : packages_(packages), reporter_(reporter), hulls_(hulls) {}

  void link(const xml::Element& link) const {
    if (const auto* inertial = only_child(link, "inertial")) this->inertial(*inertial);
    for (const xml::Element& e : link.children()) {
      if (e.name() != "collision" && e.name() != "visual") continue;
      origin(e);
      const xml::Element* geometry = only_child(e, "geometry");
      if (geometry == nullptr || geometry->children().empty()) {
        of(e).error(robot_codes::kMissing, "<" + e.name() + "> needs a <geometry> with a shape in it");
      } else {
        shape(geometry->children().front(), e.name() == "collision");
      }
    }
  }

  void joint(const xml::Element& joint) const {
    const xml::Attributes a = of(joint);
    const auto type = a.require("type") ? a.choice("type", kJointType) : std::nullopt;
    origin(joint);
    const bool moves = type != "fixed" && type != "floating";  // the axis of one that does not means nothing
    if (const auto* axis = moves ? only_child(joint, "axis") : nullptr) {
      const auto xyz = numbers(of(*axis), "xyz");
      if (xyz && std::ranges::all_of(*xyz, [](double v) { return v == 0.0; }))
        of(*axis).error_at("xyz", robot_codes::kZeroAxis,
                           "the axis is zero; it must point somewhere, e.g. \"0 0 1\"");
    }
    if (type == "revolute" || type == "prismatic") limit(joint, *type);
  }

 private:
  [[nodiscard]] xml::Attributes of(const xml::Element& e) const { return {e, kRobotFile, reporter_}; }

  void origin(const xml::Element& parent) const {
    const xml::Element* origin = only_child(parent, "origin");
    if (origin == nullptr) return;
    if (of(*origin).has("xyz")) static_cast<void>(numbers(of(*origin), "xyz"));
    const auto angles = of(*origin).has("rpy") ? numbers(of(*origin), "rpy") : std::nullopt;
    if (angles &&
        std::ranges::any_of(*angles, [](double v) { return std::fabs(v) > robot_file::values::kWholeTurn; }))
      reporter_.diagnostics().warning(robot_codes::kDegrees, origin->position(),
                                      "rpy is in radians, and one of these angles is more than a turn; is it "
                                      "one of degrees? A right angle "
                                      "is 1.5708, half a turn 3.1416");
  }

  void limit(const xml::Element& joint, const std::string& type) const {
    const xml::Element* limit = only_child(joint, "limit");
    if (limit == nullptr)
      return of(joint).error(robot_codes::kMissing, "a " + type + " joint needs the element <limit>");
    const auto low = of(*limit).has("lower") ? number(of(*limit), "lower") : 0.0;
    const auto high = of(*limit).has("upper") ? number(of(*limit), "upper") : 0.0;
    if (low && high && *low > *high)
      of(*limit).error_at("lower", robot_codes::kLimitsExchanged, "the lower limit is above the upper one");
    static_cast<void>(number(of(*limit), "effort"));
    static_cast<void>(number(of(*limit), "velocity"));
  }

  // A required attribute as a number, or as three of them; errors are reported.
  static std::optional<double> number(const xml::Attributes& a, const char* name) {
    return a.require(name) ? a.bare_number(name) : std::nullopt;
  }
  static std::optional<std::vector<double>> numbers(const xml::Attributes& a, const char* name) {
    return a.require(name) ? a.bare_numbers(name, 3) : std::nullopt;
  }

  // A child's attribute as a number; errors are reported.
  [[nodiscard]] std::optional<double> value(const xml::Element& parent, const char* child,
                                            const char* name) const {
    const xml::Element* e = only_child(parent, child);
    if (e == nullptr)
      of(parent).error(robot_codes::kMissing, "<" + parent.name() + "> needs the element <" + child + ">");
    return e != nullptr ? number(of(*e), name) : std::nullopt;
  }

  void inertial(const xml::Element& inertial) const {
    origin(inertial);
    const auto mass = value(inertial, "mass", "value");
    if (mass && *mass < 0.0)
      of(*only_child(inertial, "mass"))
          .error_at("value", robot_codes::kMass,
                    "the mass must not be negative; 0 kg, or no <inertial>, is a link that is only a frame");
    std::array<double, 6> m{};  // xx, xy, xz, yy, yz, zz.
    constexpr std::array<const char*, 6> kNames{"ixx", "ixy", "ixz", "iyy", "iyz", "izz"};
    for (std::size_t i = 0; i < m.size(); ++i) {
      const auto entry = i == 0 || only_child(inertial, "inertia") != nullptr
                             ? value(inertial, "inertia", kNames[i])
                             : std::nullopt;
      if (!entry) return;
      m[i] = *entry;
    }
    // With a mass of 0 it is as if there were no <inertial>: the link is only a frame.
    if (mass != 0.0) judge(m, *only_child(inertial, "inertia"));
  }

  using Inertia = std::array<double, 6>;  // xx, xy, xz, yy, yz, zz.

  // Sylvester's criterion.
  static bool positive_definite(const Inertia& m) {
    const double minor = m[0] * m[3] - m[1] * m[1];
    const double determinant = m[0] * (m[3] * m[5] - m[4] * m[4]) - m[1] * (m[1] * m[5] - m[4] * m[2]) +
                               m[2] * (m[1] * m[4] - m[3] * m[2]);
    return m[0] > 0.0 && minor > 0.0 && determinant > 0.0;
  }

  // No principal moment of a body is larger than the sum of the other two, that is: than half of all.
  void judge(const Inertia& m, const xml::Element& inertia) const {
    if (std::ranges::all_of(m, [](double v) { return v == 0.0; })) return;  // a point
    if (!positive_definite(m))
      return of(inertia).error(robot_codes::kInertia,
                               "the inertia is not positive definite; no body has such an inertia");
    constexpr double kTolerance = 1.02;  // of the digits in files
    const double half = kTolerance * 0.5 * (m[0] + m[3] + m[5]);
    if (positive_definite({half - m[0], -m[1], -m[2], half - m[3], -m[4], half - m[5]})) return;
    reporter_.diagnostics().warning(robot_codes::kDoubtfulInertia, inertia.position(),
                                    "no body has this inertia: one of its moments is larger than the sum of "
                                    "the other two; the robot turns by it all the "
                                    "same. Are two numbers exchanged, or is it that of another mass?");
  }

  void shape(const xml::Element& shape, bool collision) const {
    const xml::Attributes a = of(shape);
    if (shape.name() == "box") {
      const auto size = numbers(a, "size");
      if (size && std::ranges::any_of(*size, [](double v) { return v <= 0.0; })) not_positive(a, "size");
    } else if (shape.name() == "cylinder" || shape.name() == "sphere") {
      length(a, "radius");
      if (shape.name() == "cylinder") length(a, "length");
    } else if (shape.name() == "mesh") {
      if (collision) mesh(a);
    } else {
      a.error(robot_codes::kUnknownElement,
              "<" + shape.name() + "> is not a shape; known are: box, cylinder, sphere, mesh");
    }
  }

  // Only meshes for collisions are read; visual meshes are not.
  void mesh(const xml::Attributes& a) const {
    const auto name = a.require("filename") ? a.text("filename") : std::nullopt;
    const auto scale = a.has("scale") ? numbers(a, "scale") : std::vector<double>{1.0, 1.0, 1.0};
    if (scale && std::ranges::any_of(*scale, [](double v) { return v == 0.0; }))
      a.error_at("scale", robot_codes::kSize, "scale of <mesh> must not be 0");
    if (!name || hulls_.contains(*name)) return;
    const Result<MeshPlace> place = find_mesh(*name, a.element().position().file, packages_);
    if (!place) return a.error_at("filename", robot_codes::kUnreadableMesh, place.error().text());
    if (place->instead)
      reporter_.diagnostics().warning(
          robot_codes::kOtherMesh, a.element().position(),
          in_quotes(*name) + " is not read; " + place->path + " beside it is taken instead");
    const auto mesh = read_mesh(place->path);
    if (!mesh) return a.error_at("filename", robot_codes::kUnreadableMesh, mesh.error().text());
    hulls_[*name] = hull_corners(*mesh);
  }

  void length(const xml::Attributes& a, const char* name) const {
    const auto value = number(a, name);
    if (value && *value <= 0.0) not_positive(a, name);
  }
  static void not_positive(const xml::Attributes& a, const char* name) {
    a.error_at(name, robot_codes::kSize,
               std::string(name) + " of <" + a.element().name() + "> must be more than 0 m");
  }

  const std::string& packages_;
  xml::Reporter& reporter_;
  MeshHulls& hulls_;
};

// Returns whether an element, or one of its values, is to be expanded by xacro.
bool is_xacro(const xml::Element& e) {
  const auto to_expand = [](const xml::Attribute& a) {
    return a.value.find("${") != std::string::npos || a.value.find("$(") != std::string::npos;
  };
  return e.name().starts_with("xacro:") || std::ranges::any_of(e.attributes(), to_expand) ||
         std::ranges::any_of(e.children(), is_xacro);
}

}  // namespace

bool report_xacro(const xml::Element& robot, xml::Reporter& reporter) {
  if (!is_xacro(robot)) return false;
  const std::string file = robot.position().file;
  reporter.error(robot_codes::kXacro, robot.position(),
                 "this is xacro, a language from which robots are made; expand it with \"xacro " + file +
                     " > robot.urdf\", put <orca> into robot.urdf, and name that file");
  return true;
}

void check_urdf(const xml::Element& robot, const std::string& packages, xml::Reporter& reporter,
                MeshHulls& hulls) {
  const UrdfChecker checker(packages, reporter, hulls);
  for (const xml::Element& e : robot.children()) {
    if (e.name() == "link") checker.link(e);
    if (e.name() == "joint") checker.joint(e);
  }
  check_tree(robot, reporter);
}

}  // namespace orca::sim::detail
