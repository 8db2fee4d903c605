// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "public_text.hpp"

namespace orca::test {

/// Mean errors of poses against relations between them that people have measured.
struct RelationErrors {
  int count = 0, loops = 0;
  double place = 0.0, turn = 0.0, of_loops = 0.0;  ///< [m], [rad], [m]
};

/// Compares poses with relations. Those count whose two stamps are those of poses within 1 ms; a loop lies more than 60 s apart.
/// @param relations  lines "begin end x y z roll pitch yaw" [s, m, rad].
/// @param stamps [s]  of the poses, in order.
/// @source  Kuemmerle and others, "On measuring the accuracy of SLAM algorithms", Autonomous Robots 2009.
inline RelationErrors errors_of(const std::string& relations, std::span<const double> stamps,
                                std::span<const Pose2> poses) {
  RelationErrors errors;
  const auto pose_at = [&](double stamp) -> const Pose2* {
    const auto found = std::ranges::lower_bound(stamps, stamp - 1e-3);
    return found != stamps.end() && std::fabs(*found - stamp) <= 1e-3
               ? &poses[static_cast<std::size_t>(found - stamps.begin())]
               : nullptr;
  };
  std::istringstream lines(relations);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    double begin = 0.0;
    double end = 0.0;
    double unused = 0.0;
    Pose2 right;
    words >> begin >> end >> right.x >> right.y >> unused >> unused >> unused >> right.yaw;
    const Pose2* const a = pose_at(begin);
    const Pose2* const b = pose_at(end);
    if (a == nullptr || b == nullptr) continue;
    const Pose2 off = seen_from(right, seen_from(*a, *b));
    ++errors.count;
    errors.place += norm(off.position());
    errors.turn += std::fabs(off.yaw);
    if (std::fabs(end - begin) <= 60.0) continue;
    ++errors.loops;
    errors.of_loops += norm(off.position());
  }
  errors.place /= errors.count;
  errors.turn /= errors.count;
  errors.of_loops /= errors.loops;
  return errors;
}

}  // namespace orca::test
