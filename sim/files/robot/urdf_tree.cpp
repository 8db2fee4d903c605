// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/xml/attributes.hpp"
#include "orca/xml/names.hpp"
#include "urdf_check.hpp"

namespace orca::sim::detail {
namespace {

constexpr std::size_t kMaxLinks = 1000;

// The links and joints of a file, checked to be a tree.
class Tree {
 public:
  Tree(const xml::Element& robot, xml::Reporter& reporter) : robot_(robot), reporter_(reporter) {}

  void check() {
    for (const xml::Element& e : robot_.children()) {
      if (e.name() == "link") collect(e, links_);
      if (e.name() == "joint") collect(e, joints_);
    }
    if (links_.size() > kMaxLinks)
      return of(robot_).error(robot_codes::kLinkCount, "the robot has " + std::to_string(links_.size()) +
                                                           " links; at most 1000 are read");
    if (joints_.size() > kMaxLinks)
      return of(robot_).error(robot_codes::kLinkCount, "the robot has " + std::to_string(joints_.size()) +
                                                           " joints; at most 1000 are read");
    for (const auto& [name, joint] : joints_) connect(name, *joint);
    for (const auto& [name, joint] : joints_) check_mimic(name, *joint);
    if (links_.empty()) return of(robot_).error(robot_codes::kLinkCount, "the robot has no <link>");
    check_roots();
  }

 private:
  using Named = std::map<std::string, const xml::Element*>;
  [[nodiscard]] xml::Attributes of(const xml::Element& e) const { return {e, kRobotFile, reporter_}; }

  // Returns a required attribute. Reports a missing one.
  [[nodiscard]] std::optional<std::string> text(const xml::Element& e, const char* name) const {
    return of(e).require(name) ? of(e).text(name) : std::nullopt;
  }

  void collect(const xml::Element& e, Named& into) {
    const auto name = text(e, "name");
    if (!name) return;
    const auto [first, is_new] = into.emplace(*name, &e);
    if (is_new) return;
    complete_ = false;  // The links of a second joint with the same name are ignored.
    of(e).error_at("name", robot_codes::kDuplicate,
                   "there is a " + e.name() + " \"" + *name + "\" already, at " +
                       first->second->position().text() + "; choose another name");
  }

  // Returns the link that a joint's <parent> or <child> names, or empty after an error.
  [[nodiscard]] std::string end_of(const xml::Element& joint, const std::string& which) const {
    const xml::Element* end = only_child(joint, which);
    if (end == nullptr) {
      of(joint).error(robot_codes::kMissing, "<joint> needs the element <" + which + " link=\"...\"/>");
      return {};
    }
    const auto link = text(*end, "link");
    if (!link) return {};
    if (links_.contains(*link)) return *link;
    of(*end).error_at("link", robot_codes::kUnknownName,
                      "there is no link \"" + *link + "\"" + what_there_is(*link, links_));
    return {};
  }

  [[nodiscard]] static std::string what_there_is(const std::string& word, const Named& named) {
    std::vector<std::string> names;
    for (const auto& entry : named) names.push_back(entry.first);
    return "; there is: " + listed(names) + xml::did_you_mean(xml::nearest_name(word, names));
  }

  void connect(const std::string& name, const xml::Element& joint) {
    const std::string parent = end_of(joint, "parent");
    const std::string child = end_of(joint, "child");
    if (parent.empty() || child.empty()) {
      complete_ = false;
      return;
    }
    const auto [first, is_new] = parent_of_.emplace(child, parent);
    if (!is_new)
      of(joint).error(robot_codes::kTwoParents, "link \"" + child + "\" is the child of joint \"" + name +
                                                    "\" and of another joint, under \"" + first->second +
                                                    "\"; a link has one parent");
  }

  // Reports several roots and loops. Each link has at most one parent, so a link that leads up to no root is
  // in a loop or below one.
  void check_roots() const {
    std::vector<std::string> roots;
    for (const auto& [name, link] : links_)
      if (!parent_of_.contains(name)) roots.push_back(name);
    // A joint that names a missing link is reported already; its child would only look like a second root.
    if (complete_ && roots.size() > 1)
      of(robot_).error(robot_codes::kSeveralRoots, "the robot has " + std::to_string(roots.size()) +
                                                       " root links (" + listed(roots) +
                                                       "); join them by joints, so that one is left");
    for (const auto& [name, link] : links_)
      if (in_loop(name))
        return of(*link).error(robot_codes::kLoop,
                               "link \"" + name + "\" is its own ancestor: " + loop_text(name));
  }

  [[nodiscard]] bool in_loop(const std::string& name) const {
    auto up = parent_of_.find(name);
    for (std::size_t i = 0; i <= links_.size() && up != parent_of_.end(); ++i) {
      if (up->second == name) return true;
      up = parent_of_.find(up->second);
    }
    return false;
  }

  [[nodiscard]] std::string loop_text(const std::string& name) const {
    std::string text = name;
    for (std::string at = parent_of_.at(name); at != name; at = parent_of_.at(at)) text += " <- " + at;
    return text + " <- " + name;
  }

  void check_mimic(const std::string& name, const xml::Element& joint) const {
    const xml::Element* mimic = only_child(joint, "mimic");
    const auto master = mimic != nullptr ? text(*mimic, "joint") : std::nullopt;
    if (!master) return;
    if (!joints_.contains(*master))
      return of(*mimic).error_at("joint", robot_codes::kUnknownName,
                                 "there is no joint \"" + *master + "\"" + what_there_is(*master, joints_));
    const std::vector<std::string> circle = mimic_circle(name);
    if (circle.empty() || *std::ranges::min_element(circle) != name) return;  // reported once
    std::string text = name;
    for (const std::string& next : circle) text += " mimics " + next;
    of(*mimic).error(robot_codes::kLoop, "joint \"" + name + "\" mimics itself in the end: " + text);
  }

  // Returns the joints that this one mimics, up to itself; empty if they do not lead back to it.
  [[nodiscard]] std::vector<std::string> mimic_circle(const std::string& name) const {
    std::vector<std::string> circle;
    std::string at = name;
    while (circle.size() <= joints_.size()) {
      const auto joint = joints_.find(at);
      const xml::Element* mimic = joint != joints_.end() ? only_child(*joint->second, "mimic") : nullptr;
      const xml::Attribute* next = mimic != nullptr ? mimic->attribute("joint") : nullptr;
      if (next == nullptr) return {};
      at = next->value;
      circle.push_back(at);
      if (at == name) return circle;
    }
    return {};
  }

  const xml::Element& robot_;
  xml::Reporter& reporter_;
  Named links_;
  Named joints_;
  std::map<std::string, std::string> parent_of_;
  bool complete_ = true;
};

}  // namespace

void check_tree(const xml::Element& robot, xml::Reporter& reporter) { Tree(robot, reporter).check(); }

}  // namespace orca::sim::detail
