// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "legend.hpp"
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
  // The readings of many robots cover each other and the world, so each are drawn the paler.
  const double strength = 1.0 / std::max(1.0, static_cast<double>(scene.robots.size()));
  for (const Scene::Robot& robot : scene.robots) painter.readings(last_moment(robot), strength);
  painter.places(scene);
  for (std::size_t i = 0; i < scene.robots.size(); ++i) painter.track(scene.robots[i].track, robot_colour(i));
  for (std::size_t i = 0; i < scene.robots.size(); ++i) {
    const Scene::Moment last = last_moment(scene.robots[i]);
    painter.robot(scene.robots[i], last, robot_colour(i));
    if (scene.robots.size() > 1) painter.name(scene.robots[i], last, robot_colour(i));
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
  const Legend legend(scene, hidden, kWidthPixels, scale);
  return Drawing{kWidthPixels, height + legend.height(), [&scene, &hidden, window, legend](cairo_t* cairo) {
                   {
                     Painter painter(cairo, window, hidden);
                     paint(painter, scene);
                   }
                   legend.draw(cairo, window.height);
                 }};
}

}  // namespace orca::host
