// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "key_moments.hpp"
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

// Draws a square with the robot in its middle, looking up, and words below.
void draw_frame(cairo_t* cairo, const Scene& scene, const std::set<Layer>& hidden, const KeyMoment& key,
                Vec2 corner, double size) {
  const Scene::Moment& moment = *key.moment;
  {
    Painter painter(
        cairo, {corner.x, corner.y, size, size, moment.pose.position(), moment.pose.yaw, size / kShownMetres},
        hidden);
    painter.walls(scene.walls);
    painter.track(track_until(*key.robot, moment));
    painter.robot(*key.robot, moment);
    for (const Scene::Mark& arrival : scene.arrivals)
      if (arrival.time <= moment.time) painter.arrival(arrival);
    for (const Scene::Mark& contact : scene.contacts)
      if (contact.time <= moment.time) painter.contact(contact);
    painter.frame();
  }
  cairo_set_source_rgb(cairo, 0.1, 0.1, 0.1);
  cairo_set_font_size(cairo, 14);
  cairo_move_to(cairo, corner.x + 6, corner.y + size + 0.7 * kCaptionPixels);
  cairo_show_text(cairo, caption_of(key, scene.start).c_str());
}

Error nothing() {
  return fail(Code::invalid_argument, "there is nothing to draw: no simulated robot has sensed anything yet");
}

}  // namespace

Result<Drawing> robot_view(const Scene& scene, const std::set<Layer>& hidden) {
  const auto robot = std::ranges::find_if(scene.robots, [](const auto& r) { return !r.moments.empty(); });
  if (robot == scene.robots.end()) return nothing();
  const KeyMoment last{&*robot, &robot->moments.back(), "end"};
  return Drawing{kLargePixels, kLargePixels + kCaptionPixels, [&scene, &hidden, last](cairo_t* cairo) {
                   draw_frame(cairo, scene, hidden, last, {}, kLargePixels);
                 }};
}

Result<Drawing> film(const Scene& scene, const std::set<Layer>& hidden) {
  std::vector<KeyMoment> keys = key_moments(scene);
  if (keys.empty()) return nothing();
  const std::size_t columns = std::min(kColumns, keys.size());
  const std::size_t rows = (keys.size() + columns - 1) / columns;
  const double pitch = kSmallPixels + kCaptionPixels;
  return Drawing{kSmallPixels * static_cast<double>(columns), pitch * static_cast<double>(rows),
                 [&scene, &hidden, keys = std::move(keys), columns, pitch](cairo_t* cairo) {
                   for (std::size_t i = 0; i < keys.size(); ++i)
                     draw_frame(cairo, scene, hidden, keys[i],
                                {kSmallPixels * static_cast<double>(i % columns),
                                 pitch * static_cast<double>(i / columns)},
                                kSmallPixels);
                 }};
}

}  // namespace orca::host
