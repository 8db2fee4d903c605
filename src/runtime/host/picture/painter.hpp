// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cairo.h>

#include <set>
#include <string>
#include <vector>

#include "colours.hpp"
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
  /// Draws the places with their names, except where an arrival of that name is drawn. A name that would lie
  /// on another one is left out.
  void places(const Scene& scene);
  void track(const std::vector<Vec2>& points, const Colour& colour);
  void arrival(const Scene::Mark& mark);
  void contact(const Scene::Mark& mark);
  /// Draws what a robot senses at a moment of its run.
  /// @param strength  from 0 (invisible) to 1.
  void readings(const Scene::Moment& moment, double strength);
  /// Draws the robot and what it does at a moment of its run.
  void robot(const Scene::Robot& robot, const Scene::Moment& moment, const Colour& colour);
  /// Writes the name of a robot beside it.
  void name(const Scene::Robot& robot, const Scene::Moment& moment, const Colour& colour);
  void frame();

 private:
  [[nodiscard]] bool shows(Layer layer) const { return !hidden_.contains(layer); }
  void pen(const Colour& colour, double width_pixels);
  void ring(Vec2 centre, double radius);
  void mark(const Scene::Mark& mark, const Colour& colour);
  void letters(Vec2 beside, Vec2 offset_pixels, double height_pixels, const std::string& text);
  [[nodiscard]] bool take_room(Vec2 position, const std::string& text);
  void enter(const Pose2& pose);
  void outline(const Scene::Robot& robot);
  void body(const Scene::Robot& robot, const Colour& colour);
  void cone(const Scene::Cone& cone, double strength);
  void scan(const Scene::Scan& scan, double strength);
  void motion(const Scene::Moment& moment);
  void head(Vec2 tip, double direction_rad);

  cairo_t* const cairo_;
  const Window window_;
  const std::set<Layer>& hidden_;
  const double pixel_;        // [m] width of a pixel
  std::vector<Vec2> labels_;  // [pixels] beginnings and ends of the names of places, in turn
};

}  // namespace orca::host
