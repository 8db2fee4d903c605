// SPDX-License-Identifier: LGPL-3.0-or-later
#include "urdf_check.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "orca/robots/codes.hpp"
#include "orca/xml/attributes.hpp"
#include "robot_rules.hpp"
#include "urdf_parts.hpp"

namespace orca::robots::detail {
namespace {

class UrdfChecker {
 public:
  UrdfChecker(xml::Reporter& reporter, BodyReader* body, MeshHulls& hulls)
      : reporter_(reporter), body_(body), hulls_(hulls) {}

  void link(const xml::Element& link) const {
    if (const auto* inertial = only_child(link, "inertial")) this->inertial(*inertial);
    for (const xml::Element& e : link.children()) {
      if (e.name() != "collision" && e.name() != "visual") continue;
      origin(e);
      const xml::Element* geometry = only_child(e, "geometry");
      if (geometry == nullptr || geometry->children().empty()) {
        of(e).error(codes::kMissing, "<" + e.name() + "> needs a <geometry> with a shape in it");
      } else {
        shape(geometry->children().front(), e.name() == "collision");
      }
    }
  }

  void joint(const xml::Element& joint) const {
    const xml::Attributes a = of(joint);
    const auto type = a.require("type") ? a.choice("type", kJointType) : std::nullopt;
    origin(joint);
    if (const auto* axis = only_child(joint, "axis")) {
      const auto xyz = numbers(of(*axis), "xyz");
      if (xyz && std::ranges::all_of(*xyz, [](double v) { return v == 0.0; }))
        of(*axis).error_at("xyz", codes::kZeroAxis,
                           "the axis is zero; it must point somewhere, e.g. \"0 0 1\"");
    }
    if (type == "revolute" || type == "prismatic") limit(joint, *type);
  }

 private:
  [[nodiscard]] xml::Attributes of(const xml::Element& e) const { return {e, kRobotFile, reporter_}; }

  void origin(const xml::Element& parent) const {
    const xml::Element* origin = only_child(parent, "origin");
    if (origin == nullptr) return;
    for (const char* name : {"xyz", "rpy"})
      if (of(*origin).has(name)) static_cast<void>(numbers(of(*origin), name));
  }

  void limit(const xml::Element& joint, const std::string& type) const {
    const xml::Element* limit = only_child(joint, "limit");
    if (limit == nullptr)
      return of(joint).error(codes::kMissing, "a " + type + " joint needs the element <limit>");
    const auto low = of(*limit).has("lower") ? number(of(*limit), "lower") : 0.0;
    const auto high = of(*limit).has("upper") ? number(of(*limit), "upper") : 0.0;
    if (low && high && *low > *high)
      of(*limit).error_at("lower", codes::kLimitsExchanged, "the lower limit is above the upper one");
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
      of(parent).error(codes::kMissing, "<" + parent.name() + "> needs the element <" + child + ">");
    return e != nullptr ? number(of(*e), name) : std::nullopt;
  }

  void inertial(const xml::Element& inertial) const {
    origin(inertial);
    const auto mass = value(inertial, "mass", "value");
    if (mass && *mass <= 0.0)
      of(*only_child(inertial, "mass"))
          .error_at("value", codes::kMass,
                    "the mass must be more than 0 kg; leave <inertial> out for a link that is only a frame");
    std::array<double, 6> m{};  // xx, xy, xz, yy, yz, zz.
    constexpr std::array<const char*, 6> kNames{"ixx", "ixy", "ixz", "iyy", "iyz", "izz"};
    for (std::size_t i = 0; i < m.size(); ++i) {
      const auto entry = i == 0 || only_child(inertial, "inertia") != nullptr
                             ? value(inertial, "inertia", kNames[i])
                             : std::nullopt;
      if (!entry) return;
      m[i] = *entry;
    }
    const double minor = m[0] * m[3] - m[1] * m[1];
    const double determinant = m[0] * (m[3] * m[5] - m[4] * m[4]) - m[1] * (m[1] * m[5] - m[4] * m[2]) +
                               m[2] * (m[1] * m[4] - m[3] * m[2]);
    if (!(m[0] > 0.0 && minor > 0.0 && determinant > 0.0))  // Sylvester's criterion.
      of(*only_child(inertial, "inertia"))
          .error(codes::kInertia, "the inertia is not positive definite; no body has such an inertia");
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
      a.error(codes::kUnknownElement,
              "<" + shape.name() + "> is not a shape; known are: box, cylinder, sphere, mesh");
    }
  }

  // Only meshes for collisions are read; visual meshes are not.
  void mesh(const xml::Attributes& a) const {
    const auto name = a.require("filename") ? a.text("filename") : std::nullopt;
    const auto scale = a.has("scale") ? numbers(a, "scale") : std::vector<double>{1.0, 1.0, 1.0};
    if (scale && std::ranges::any_of(*scale, [](double v) { return v == 0.0; }))
      a.error_at("scale", codes::kSize, "scale of <mesh> must not be 0");
    if (!name || hulls_.contains(*name)) return;
    if (name->find("://") != std::string::npos)
      return a.error_at("filename", codes::kUnreadableMesh,
                        "\"" + *name + "\" cannot be looked up; write the path, beside this file or from /");
    const auto folder = std::filesystem::path(a.element().position().file).parent_path();
    Result<std::vector<Vec3>> hull = std::vector<Vec3>{};
    if (body_ != nullptr) hull = body_->hull_of((folder / *name).lexically_normal().string());
    if (!hull) return a.error_at("filename", codes::kUnreadableMesh, hull.error().text());
    hulls_[*name] = std::move(hull).value();
  }

  void length(const xml::Attributes& a, const char* name) const {
    const auto value = number(a, name);
    if (value && *value <= 0.0) not_positive(a, name);
  }
  static void not_positive(const xml::Attributes& a, const char* name) {
    a.error_at(name, codes::kSize,
               std::string(name) + " of <" + a.element().name() + "> must be more than 0 m");
  }

  xml::Reporter& reporter_;
  BodyReader* const body_;
  MeshHulls& hulls_;
};

}  // namespace

void check_urdf(const xml::Element& robot, xml::Reporter& reporter, BodyReader* body, MeshHulls& hulls) {
  const UrdfChecker checker(reporter, body, hulls);
  for (const xml::Element& e : robot.children()) {
    if (e.name() == "link") checker.link(e);
    if (e.name() == "joint") checker.joint(e);
  }
  check_tree(robot, reporter);
}

}  // namespace orca::robots::detail
