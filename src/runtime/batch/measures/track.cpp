// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cstdio>

#include "orca/batch/measures.hpp"
#include "orca/hw/scene.hpp"

namespace orca::batch {
namespace {

constexpr std::size_t kIntervals = 128;

std::string place_text(const Scene::Step& step) {
  char text[64];
  std::snprintf(text, sizeof text, "%.2f %.2f", step.pose.x, step.pose.y);
  return text;
}

}  // namespace

std::string track_text(const Scene& scene) {
  std::string text;
  for (const Scene::Robot& robot : scene.robots) {
    if (!text.empty()) text += ';';
    const std::size_t count = robot.motion.size();
    const std::size_t each = count / kIntervals + 1;
    for (std::size_t i = 0; i < count; i += each) text += (i == 0 ? "" : ",") + place_text(robot.motion[i]);
    if (count > 0 && (count - 1) % each != 0) text += "," + place_text(robot.motion.back());
  }
  return text;
}

}  // namespace orca::batch
