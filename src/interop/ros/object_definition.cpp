// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cctype>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "orca/ros/message_type.hpp"

namespace orca::ros {
namespace {

// Names of types that are not Orca's own have a dot, "my.Light", and those of ROS must not.
std::string without_dots(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '.', '_');
  return text;
}

// A reader of the flattened layout of an object type, which idl/tools/idl_model.py writes: "Name:Parent{field:type {unit},...}". It
// comes from our own library, so it is right.
class LayoutReader {
 public:
  explicit LayoutReader(std::string_view layout) : left_(layout) {}

  std::string definition() {
    (void)word();
    if (take(':')) (void)word();  // the parent
    std::string text = fields();
    for (const std::string& name : order_)
      text += std::string(80, '=') + "\nMSG: orca_values/" + name + "\n" + parts_[name];
    return text;
  }

 private:
  bool take(char c) {
    if (left_.empty() || left_.front() != c) return false;
    left_.remove_prefix(1);
    return true;
  }

  std::string word() {
    std::size_t n = 0;
    const auto belongs = [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
    };
    while (n < left_.size() && belongs(left_[n])) ++n;
    std::string text = without_dots(left_.substr(0, n));
    left_.remove_prefix(n);
    return text;
  }

  // Reads "{name:type {unit},...}".
  std::string fields() {
    std::string text;
    std::set<std::string> enumerations;  // whose constants are there
    (void)take('{');
    while (!left_.empty() && !take('}')) {
      const std::string name = word();
      (void)take(':');
      std::string constants;
      const std::string type = this->type(constants, enumerations);
      const std::string unit = this->unit();
      text += constants + type + " " + name + (unit.empty() ? "" : "  # [" + unit + "]") + "\n";
      (void)take(',');
    }
    return text;
  }

  std::string type(std::string& constants, std::set<std::string>& enumerations) {
    const std::string name = word();
    if (take(':')) (void)word();  // its parent
    if (name == "sequence") {
      (void)take('<');
      const std::string element = type(constants, enumerations);
      (void)take('>');
      return element + "[]";
    }
    std::string known = name == "double" ? "float64" : name;
    if (!left_.empty() && left_.front() == '(') {
      const std::string all = enumerators();
      if (enumerations.insert(name).second) constants = all;
      known = "uint32";
    } else if (!left_.empty() && left_.front() == '{') {
      std::string inner = fields();
      if (parts_.emplace(name, std::move(inner)).second) order_.push_back(name);
      known = "orca_values/" + name;
    }
    if (!take('[')) return known;
    const std::string count = word();
    (void)take(']');
    return known + "[" + count + "]";
  }

  // Reads "(A,B,...)" as constants.
  std::string enumerators() {
    std::string text;
    (void)take('(');
    for (int value = 0; !left_.empty() && !take(')'); ++value) {
      text += "uint32 " + word() + "=" + std::to_string(value) + "\n";
      (void)take(',');
    }
    return text;
  }

  std::string unit() {
    if (!left_.starts_with(" {")) return {};
    const std::size_t end = left_.find('}');
    std::string text(left_.substr(2, end - 2));
    left_.remove_prefix(end + 1);
    return text;
  }

  std::string_view left_;
  std::map<std::string, std::string> parts_;  // by name
  std::vector<std::string> order_;            // of parts_
};

}  // namespace

MessageType message_type_of(const ObjectType& type) {
  return {"orca/msg/" + without_dots(type.name), LayoutReader(type.layout).definition()};
}

}  // namespace orca::ros
