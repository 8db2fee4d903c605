// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cairo.h>

#include <set>
#include <string>
#include <vector>

#include "orca/host/picture.hpp"

namespace orca::host {

/// A rectangle of the picture [pixels] and the part of the world that it shows.
struct Window {
  double left = 0.0;
  double top = 0.0;
  double width = 0.0;
  double height = 0.0;
  Vec2 centre;          ///< Point of the world in the middle of the window.
  double up_rad = 0.0;  ///< Direction of the world that points up.
  double scale = 1.0;   ///< [pixels/m]
};

/// A painter of shapes given in metres. It draws into a window, and nothing outside of it.
class Painter {
 public:
  Painter(cairo_t* cairo, const Window& window, const std::set<Layer>& hidden);
  ~Painter();
  Painter(const Painter&) = delete;
  Painter& operator=(const Painter&) = delete;

  void walls(const std::vector<Scene::Line>& lines);
  void track(const std::vector<Vec2>& points);
  void arrival(const Scene::Mark& mark);
  void contact(const Scene::Mark& mark);
  /// Draws the robot, what it does and what it senses, at a moment of its run.
  void robot(const Scene::Robot& robot, const Scene::Moment& moment);
  void frame();

 private:
  struct Colour {
    double red, green, blue, alpha = 1.0;
  };
  [[nodiscard]] bool shows(Layer layer) const { return !hidden_.contains(layer); }
  void pen(const Colour& colour, double width_pixels);
  void ring(Vec2 centre, double radius);
  void mark(const Scene::Mark& mark, const Colour& colour);
  void body(const Scene::Robot& robot);
  void cone(const Scene::Cone& cone);
  void scan(const Scene::Scan& scan);
  void motion(const Scene::Moment& moment);
  void head(Vec2 tip, double direction_rad);

  cairo_t* const cairo_;
  const Window window_;
  const std::set<Layer>& hidden_;
  const double pixel_;  // [m] width of a pixel
};

}  // namespace orca::host
