// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cstdio>

#include "orca/batch/measures.hpp"
#include "orca/hw/scene.hpp"

namespace orca::batch {
namespace {

constexpr std::size_t kIntervals = 128;
constexpr std::size_t kMostContacts = 8;

std::string place_text(Vec2 place) {
  char text[64];
  std::snprintf(text, sizeof text, "%.2f %.2f", place.x, place.y);
  return text;
}

std::string tracks_of(const Scene& scene) {
  std::string text;
  for (const Scene::Robot& robot : scene.robots) {
    if (!text.empty()) text += ';';
    const std::size_t count = robot.motion.size();
    const std::size_t each = count / kIntervals + 1;
    for (std::size_t i = 0; i < count; i += each)
      text += (i == 0 ? "" : ",") + place_text(robot.motion[i].pose.position());
    if (count > 0 && (count - 1) % each != 0) text += "," + place_text(robot.motion.back().pose.position());
  }
  return text;
}

std::string contacts_of(const Scene& scene) {
  std::string text;
  for (std::size_t i = 0; i < std::min(scene.contacts.size(), kMostContacts); ++i)
    text += (i == 0 ? "" : ";") + place_text(scene.contacts[i].position);
  return text;
}

// A wall that begins where the one before ends goes on with its line.
std::string walls_of(const Scene& scene) {
  std::string text;
  std::string last;
  for (const Scene::Line& wall : scene.walls) {
    const std::string from = place_text(wall.a);
    if (from != last) text += (text.empty() ? "" : ";") + from;
    last = place_text(wall.b);
    text += "," + last;
  }
  return text;
}

}  // namespace

Sketch sketch_of(const Scene& scene) { return {tracks_of(scene), contacts_of(scene), walls_of(scene)}; }

}  // namespace orca::batch
