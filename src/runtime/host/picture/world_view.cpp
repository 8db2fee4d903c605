// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "painter.hpp"
#include "views.hpp"

namespace orca::host {
namespace {

constexpr double kWidthPixels = 1200.0;
constexpr double kMarginMetres = 0.5;

struct Box {
  double min_x = std::numeric_limits<double>::infinity();
  double min_y = std::numeric_limits<double>::infinity();
  double max_x = -std::numeric_limits<double>::infinity();
  double max_y = -std::numeric_limits<double>::infinity();

  void add(Vec2 p) {
    min_x = std::min(min_x, p.x - kMarginMetres);
    max_x = std::max(max_x, p.x + kMarginMetres);
    min_y = std::min(min_y, p.y - kMarginMetres);
    max_y = std::max(max_y, p.y + kMarginMetres);
  }
  [[nodiscard]] bool empty() const { return min_x > max_x; }
};

Box bounds(const Scene& scene) {
  Box box;
  for (const Scene::Line& wall : scene.walls) {
    box.add(wall.a);
    box.add(wall.b);
  }
  for (const Scene::Robot& robot : scene.robots) box.add(robot.pose.position());
  return box;
}

// Returns the robot's last pose, with its last sensor readings.
Scene::Moment last_moment(const Scene::Robot& robot) {
  Scene::Moment moment = robot.moments.empty() ? Scene::Moment{} : robot.moments.back();
  moment.pose = robot.pose;
  return moment;
}

void paint(Painter& painter, const Scene& scene) {
  painter.walls(scene.walls);
  for (const Scene::Robot& robot : scene.robots) {
    painter.track(robot.track);
    painter.robot(robot, last_moment(robot));
  }
  for (const Scene::Mark& arrival : scene.arrivals) painter.arrival(arrival);
  for (const Scene::Mark& contact : scene.contacts) painter.contact(contact);
}

}  // namespace

Result<Drawing> world_view(const Scene& scene, const std::set<Layer>& hidden) {
  const Box box = bounds(scene);
  if (box.empty())
    return fail(Code::invalid_argument, "there is nothing to draw: the graph has no simulated hardware");
  const double scale = kWidthPixels / (box.max_x - box.min_x);
  const double height = std::ceil(scale * (box.max_y - box.min_y));
  const Vec2 centre{0.5 * (box.min_x + box.max_x), 0.5 * (box.min_y + box.max_y)};
  const Window window{0, 0, kWidthPixels, height, centre, 0.5 * std::numbers::pi, scale};
  return Drawing{kWidthPixels, height, [&scene, &hidden, window](cairo_t* cairo) {
                   Painter painter(cairo, window, hidden);
                   paint(painter, scene);
                 }};
}

}  // namespace orca::host
