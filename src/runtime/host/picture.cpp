// SPDX-License-Identifier: LGPL-3.0-or-later
#include "picture.hpp"

#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace orca {
namespace {

constexpr double kWidthPixels = 1200.0;
constexpr double kMarginMetres = 0.5;

struct Box {
  double min_x = std::numeric_limits<double>::infinity();
  double min_y = std::numeric_limits<double>::infinity();
  double max_x = -std::numeric_limits<double>::infinity();
  double max_y = -std::numeric_limits<double>::infinity();

  void add(const Scene::Point& p) {
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
  for (const Scene::Robot& robot : scene.robots) box.add(robot.position);
  return box;
}

// Draws in metres: x right, y up.
class Painter {
 public:
  Painter(cairo_surface_t* surface, const Box& box, double scale)
      : cairo_(cairo_create(surface)), pixel_(1.0 / scale) {
    cairo_set_source_rgb(cairo_, 1, 1, 1);
    cairo_paint(cairo_);
    cairo_scale(cairo_, scale, -scale);
    cairo_translate(cairo_, -box.min_x, -box.max_y);
    cairo_set_line_cap(cairo_, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
  }
  ~Painter() { cairo_destroy(cairo_); }
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  void walls(const std::vector<Scene::Line>& lines) {
    colour(0.15, 0.15, 0.15, 1.6);
    for (const Scene::Line& line : lines) {
      cairo_move_to(cairo_, line.a.x, line.a.y);
      cairo_line_to(cairo_, line.b.x, line.b.y);
    }
    cairo_stroke(cairo_);
  }

  void robot(const Scene::Robot& robot) {
    colour(0.12, 0.35, 0.75, 2.0);
    for (const Scene::Point& p : robot.track) cairo_line_to(cairo_, p.x, p.y);
    cairo_stroke(cairo_);
    if (!robot.track.empty()) ring(robot.track.front(), 4 * pixel_);
    colour(0.8, 0.1, 0.1, 2.0);
    ring(robot.position, robot.radius_m);
    cairo_move_to(cairo_, robot.position.x, robot.position.y);
    cairo_line_to(cairo_, robot.position.x + robot.radius_m * std::cos(robot.heading_rad),
                  robot.position.y + robot.radius_m * std::sin(robot.heading_rad));
    cairo_stroke(cairo_);
  }

  void mark(const Scene::Mark& mark, double red, double green, double blue) {
    colour(red, green, blue, 3.0);
    ring(mark.position, 7 * pixel_);
    cairo_save(cairo_);
    cairo_translate(cairo_, mark.position.x + 10 * pixel_, mark.position.y + 10 * pixel_);
    cairo_scale(cairo_, pixel_, -pixel_);
    cairo_set_font_size(cairo_, 16);
    cairo_move_to(cairo_, 0, 0);
    cairo_show_text(cairo_, mark.label.c_str());
    cairo_restore(cairo_);
  }

 private:
  void colour(double red, double green, double blue, double width_pixels) {
    cairo_set_source_rgb(cairo_, red, green, blue);
    cairo_set_line_width(cairo_, width_pixels * pixel_);
  }
  void ring(const Scene::Point& centre, double radius) {
    cairo_new_sub_path(cairo_);
    cairo_arc(cairo_, centre.x, centre.y, radius, 0, 2 * M_PI);
    cairo_stroke(cairo_);
  }

  cairo_t* cairo_;
  double pixel_;  // [m]
};

using Surface = std::unique_ptr<cairo_surface_t, void (*)(cairo_surface_t*)>;

Surface make_surface(const std::string& path, double width, double height) {
  cairo_surface_t* const surface =
      path.ends_with(".svg")
          ? cairo_svg_surface_create(path.c_str(), width, height)
          : cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width), static_cast<int>(height));
  return {surface, cairo_surface_destroy};
}

Status finish(cairo_surface_t* surface, const std::string& path) {
  cairo_status_t status = cairo_surface_status(surface);
  if (status == CAIRO_STATUS_SUCCESS && path.ends_with(".png"))
    status = cairo_surface_write_to_png(surface, path.c_str());
  cairo_surface_finish(surface);
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface);
  if (status == CAIRO_STATUS_SUCCESS) return ok();
  return fail(Code::unavailable, std::string("cannot write the picture: ") + cairo_status_to_string(status),
              path);
}

}  // namespace

Status write_picture(const Scene& scene, const std::string& path) {
  if (!path.ends_with(".svg") && !path.ends_with(".png"))
    return fail(Code::invalid_argument, "a picture's name ends in .svg or .png", path);
  const Box box = bounds(scene);
  if (box.empty())
    return fail(Code::invalid_argument, "there is nothing to draw: the graph has no simulated hardware",
                path);
  const double scale = kWidthPixels / (box.max_x - box.min_x);
  const Surface surface = make_surface(path, kWidthPixels, std::ceil(scale * (box.max_y - box.min_y)));
  {
    Painter painter(surface.get(), box, scale);
    painter.walls(scene.walls);
    for (const Scene::Robot& robot : scene.robots) painter.robot(robot);
    for (const Scene::Mark& arrival : scene.arrivals) painter.mark(arrival, 0.0, 0.55, 0.2);
    for (const Scene::Mark& contact : scene.contacts) painter.mark(contact, 0.9, 0.0, 0.0);
  }
  return finish(surface.get(), path);
}

}  // namespace orca
