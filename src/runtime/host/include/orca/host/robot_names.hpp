// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

namespace orca::host {

/// The robots of a system, and which of its components serves which. A plain value.
struct RobotNames {
  std::vector<std::string> robots;                  ///< Each one word, in the order of the graph.
  std::map<std::string, std::string> by_component;  ///< Only components that serve one robot alone.

  [[nodiscard]] bool several() const { return robots.size() > 1; }
  /// Returns the robot that a component serves; empty: none, or several equally.
  [[nodiscard]] std::string of(const std::string& component) const {
    const auto found = by_component.find(component);
    return found == by_component.end() ? std::string() : found->second;
  }
  friend bool operator==(const RobotNames&, const RobotNames&) = default;
};

}  // namespace orca::host
