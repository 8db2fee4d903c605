// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "key_moments.hpp"
#include "legend.hpp"
#include "painter.hpp"
#include "views.hpp"

namespace orca::host {
namespace {

constexpr double kShownMetres = 8.0;  // [m] from side to side
constexpr double kLargePixels = 800.0;
constexpr double kSmallPixels = 400.0;
constexpr double kCaptionPixels = 26.0;
constexpr std::size_t kColumns = 3;

std::string caption_of(const KeyMoment& key, TimePoint start) {
  const auto shown = [](double value) { return std::round(100.0 * value) / 100.0 + 0.0; };  // never -0.00
  char numbers[96];
  std::snprintf(numbers, sizeof numbers, "%.1f s  %.2f m/s  %.2f rad/s", to_seconds(key.moment->time - start),
                shown(key.moment->speed), shown(key.moment->turn_rate));
  return key.robot->name + "  " + numbers + (key.why.empty() ? "" : "  " + key.why);
}

// Returns the track up to a moment, made of the moments. These are fewer than the points of the whole track.
std::vector<Vec2> track_until(const Scene::Robot& robot, const Scene::Moment& now) {
  if (&now == &robot.moments.back()) return robot.track;
  std::vector<Vec2> points;
  for (const Scene::Moment& moment : robot.moments)
    if (moment.time <= now.time) points.push_back(moment.pose.position());
  return points;
}

std::size_t number_of(const Scene& scene, const Scene::Robot& robot) {
  return static_cast<std::size_t>(&robot - scene.robots.data());
}

// Draws all robots at the time of a moment of one of them, whose readings are drawn as well.
void draw_robots(Painter& painter, const Scene& scene, const KeyMoment& key) {
  painter.readings(*key.moment, 1.0);
  for (std::size_t i = 0; i < scene.robots.size(); ++i) {
    const Scene::Robot& robot = scene.robots[i];
    if (robot.moments.empty()) continue;
    const Scene::Moment& moment = &robot == key.robot ? *key.moment : moment_at(robot, key.moment->time);
    painter.track(track_until(robot, moment), robot_colour(i));
    painter.robot(robot, moment, robot_colour(i));
    if (scene.robots.size() > 1) painter.name(robot, moment, robot_colour(i));
  }
}

void draw_caption(cairo_t* cairo, const Scene& scene, const KeyMoment& key, Vec2 corner) {
  set_colour(cairo, robot_colour(number_of(scene, *key.robot)));
  cairo_rectangle(cairo, corner.x + 6, corner.y + 7, 12, 12);
  cairo_fill(cairo);
  set_colour(cairo, kInk);
  cairo_set_font_size(cairo, 14);
  cairo_move_to(cairo, corner.x + 24, corner.y + 0.7 * kCaptionPixels);
  cairo_show_text(cairo, caption_of(key, scene.start).c_str());
}

// Draws a square with the robot in its middle, looking up, and words below.
void draw_frame(cairo_t* cairo, const Scene& scene, const std::set<Layer>& hidden, const KeyMoment& key,
                Vec2 corner, double size) {
  const Scene::Moment& moment = *key.moment;
  {
    Painter painter(
        cairo, {corner.x, corner.y, size, size, moment.pose.position(), moment.pose.yaw, size / kShownMetres},
        hidden);
    painter.walls(scene.walls);
    painter.places(scene);
    draw_robots(painter, scene, key);
    for (const Scene::Mark& arrival : scene.arrivals)
      if (arrival.time <= moment.time) painter.arrival(arrival);
    for (const Scene::Mark& contact : scene.contacts)
      if (contact.time <= moment.time) painter.contact(contact);
    painter.frame();
  }
  draw_caption(cairo, scene, key, {corner.x, corner.y + size});
}

Error nothing() {
  return fail(Code::invalid_argument, "there is nothing to draw: no simulated robot has sensed anything yet");
}

}  // namespace

Result<Drawing> robot_view(const Scene& scene, const std::set<Layer>& hidden) {
  const auto robot = std::ranges::find_if(scene.robots, [](const auto& r) { return !r.moments.empty(); });
  if (robot == scene.robots.end()) return nothing();
  const KeyMoment last{&*robot, &robot->moments.back(), "end"};
  constexpr double kBottom = kLargePixels + kCaptionPixels;
  const Legend legend(scene, hidden, kLargePixels, kLargePixels / kShownMetres);
  return Drawing{kLargePixels, kBottom + legend.height(), [&scene, &hidden, last, legend](cairo_t* cairo) {
                   draw_frame(cairo, scene, hidden, last, {}, kLargePixels);
                   legend.draw(cairo, kBottom);
                 }};
}

Result<Drawing> film(const Scene& scene, const std::set<Layer>& hidden) {
  std::vector<KeyMoment> keys = key_moments(scene);
  if (keys.empty()) return nothing();
  const std::size_t columns = std::min(kColumns, keys.size());
  const std::size_t rows = (keys.size() + columns - 1) / columns;
  const double pitch = kSmallPixels + kCaptionPixels;
  const double width = kSmallPixels * static_cast<double>(columns);
  const double bottom = pitch * static_cast<double>(rows);
  const Legend legend(scene, hidden, width, kSmallPixels / kShownMetres);
  return Drawing{width, bottom + legend.height(),
                 [&scene, &hidden, keys = std::move(keys), columns, pitch, legend, bottom](cairo_t* cairo) {
                   for (std::size_t i = 0; i < keys.size(); ++i)
                     draw_frame(cairo, scene, hidden, keys[i],
                                {kSmallPixels * static_cast<double>(i % columns),
                                 pitch * static_cast<double>(i / columns)},
                                kSmallPixels);
                   legend.draw(cairo, bottom);
                 }};
}

}  // namespace orca::host
