// SPDX-License-Identifier: LGPL-3.0-or-later
#include "urdf_check.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "files/formats/attributes.hpp"
#include "motion/hull_corners.hpp"
#include "urdf_parts.hpp"

namespace orca::sim::detail {
namespace {

class UrdfChecker {
 public:
  UrdfChecker(xml::Diagnostics& diagnostics, MeshHulls& hulls) : diagnostics_(diagnostics), hulls_(hulls) {}

  void link(const xml::Element& link) const {
    if (const auto* inertial = only_child(link, "inertial")) this->inertial(*inertial);
    for (const xml::Element& e : link.children()) {
      if (e.name() != "collision" && e.name() != "visual") continue;
      origin(e);
      const xml::Element* geometry = only_child(e, "geometry");
      if (geometry == nullptr || geometry->children().empty()) {
        of(e).error(4, "<" + e.name() + "> needs a <geometry> with a shape in it");
      } else {
        shape(geometry->children().front(), e.name() == "collision");
      }
    }
  }

  void joint(const xml::Element& joint) const {
    static const std::vector<std::string> kTypes{"fixed",     "continuous", "revolute",
                                                 "prismatic", "planar",     "floating"};
    const auto type = of(joint).choice("type", kTypes);
    origin(joint);
    if (const auto* axis = only_child(joint, "axis")) {
      const auto xyz = of(*axis).numbers("xyz", 3);
      if (xyz && std::ranges::all_of(*xyz, [](double v) { return v == 0.0; }))
        of(*axis).error_at("xyz", 16, "the axis is zero; it must point somewhere, e.g. \"0 0 1\"");
    }
    if (type == "revolute" || type == "prismatic") limit(joint, *type);
  }

 private:
  [[nodiscard]] Attributes of(const xml::Element& e) const { return {e, 'R', diagnostics_}; }

  void origin(const xml::Element& parent) const {
    const xml::Element* origin = only_child(parent, "origin");
    if (origin == nullptr) return;
    for (const char* name : {"xyz", "rpy"})
      if (of(*origin).has(name)) static_cast<void>(of(*origin).numbers(name, 3));
  }

  void limit(const xml::Element& joint, const std::string& type) const {
    const xml::Element* limit = only_child(joint, "limit");
    if (limit == nullptr) return of(joint).error(4, "a " + type + " joint needs the element <limit>");
    const auto low = of(*limit).has("lower") ? of(*limit).number("lower") : 0.0;
    const auto high = of(*limit).has("upper") ? of(*limit).number("upper") : 0.0;
    if (low && high && *low > *high)
      of(*limit).error_at("lower", 17, "the lower limit is above the upper one");
    static_cast<void>(of(*limit).number("effort"));
    static_cast<void>(of(*limit).number("velocity"));
  }

  // A child's attribute as a number; errors told.
  [[nodiscard]] std::optional<double> value(const xml::Element& parent, const char* child,
                                            const char* name) const {
    const xml::Element* e = only_child(parent, child);
    if (e == nullptr) of(parent).error(4, "<" + parent.name() + "> needs the element <" + child + ">");
    return e != nullptr ? of(*e).number(name) : std::nullopt;
  }

  void inertial(const xml::Element& inertial) const {
    origin(inertial);
    const auto mass = value(inertial, "mass", "value");
    if (mass && *mass <= 0.0)
      of(*only_child(inertial, "mass"))
          .error_at("value", 18,
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
          .error(19, "the inertia is not positive definite; no body has such an inertia");
  }

  void shape(const xml::Element& shape, bool collision) const {
    const Attributes a = of(shape);
    if (shape.name() == "box") {
      const auto size = a.numbers("size", 3);
      if (size && std::ranges::any_of(*size, [](double v) { return v <= 0.0; })) not_positive(a, "size");
    } else if (shape.name() == "cylinder" || shape.name() == "sphere") {
      length(a, "radius");
      if (shape.name() == "cylinder") length(a, "length");
    } else if (shape.name() == "mesh") {
      if (collision) mesh(a);
    } else {
      a.error(2, "<" + shape.name() + "> is not a shape; known are: box, cylinder, sphere, mesh");
    }
  }

  // Pictures of a robot are nobody's concern here: only meshes for collisions are read.
  void mesh(const Attributes& a) const {
    const auto name = a.text("filename");
    const auto scale = a.has("scale") ? a.numbers("scale", 3) : std::vector<double>{1.0, 1.0, 1.0};
    if (scale && std::ranges::any_of(*scale, [](double v) { return v == 0.0; }))
      a.error_at("scale", 20, "scale of <mesh> must not be 0");
    if (!name || hulls_.contains(*name)) return;
    if (name->find("://") != std::string::npos)
      return a.error_at("filename", 21,
                        "\"" + *name + "\" cannot be looked up; write the path, beside this file or from /");
    const auto folder = std::filesystem::path(a.element().position().file).parent_path();
    const auto mesh = read_mesh((folder / *name).lexically_normal().string());
    if (!mesh) return a.error_at("filename", 21, mesh.error().text());
    hulls_[*name] = hull_corners(*mesh);
  }

  void length(const Attributes& a, const char* name) const {
    const auto value = a.number(name);
    if (value && *value <= 0.0) not_positive(a, name);
  }
  static void not_positive(const Attributes& a, const char* name) {
    a.error_at(name, 20, std::string(name) + " of <" + a.element().name() + "> must be more than 0 m");
  }

  xml::Diagnostics& diagnostics_;
  MeshHulls& hulls_;
};

}  // namespace

void check_urdf(const xml::Element& robot, xml::Diagnostics& diagnostics, MeshHulls& hulls) {
  const UrdfChecker checker(diagnostics, hulls);
  for (const xml::Element& e : robot.children()) {
    if (e.name() == "link") checker.link(e);
    if (e.name() == "joint") checker.joint(e);
  }
  check_tree(robot, diagnostics);
}

}  // namespace orca::sim::detail
