// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>

#include "orca/geometry/pose2.hpp"

namespace orca::sim::detail {

// Returns a position for messages, in whole centimetres: "(3.10, 6.02) m".
inline std::string text(const Pose2& pose) {
  const auto number = [](double v) {
    std::string s = std::to_string(v);
    return s.substr(0, s.find('.') + 3);
  };
  return "(" + number(pose.x) + ", " + number(pose.y) + ") m";
}

}  // namespace orca::sim::detail
