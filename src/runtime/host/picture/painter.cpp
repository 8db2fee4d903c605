// SPDX-License-Identifier: LGPL-3.0-or-later
#include "painter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace orca::host {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSamePlace = 0.5;          // [m] an arrival nearer than this is at the place
constexpr double kPlacePixels = 10.0;       // height of the names of places
constexpr double kTurnRadius = 0.6;         // [m] radius of the arc that shows a turn
constexpr double kLeastMotion = 0.02;       // [m/s, rad/s] slower motion is not drawn
constexpr double kLongestTurn = 1.9 * kPi;  // [rad] so that an arc never closes

}  // namespace

Painter::Painter(cairo_t* cairo, const Window& window, const std::set<Layer>& hidden)
    : cairo_(cairo), window_(window), hidden_(hidden), pixel_(1.0 / window.scale) {
  cairo_save(cairo_);
  cairo_rectangle(cairo_, window.left, window.top, window.width, window.height);
  cairo_clip(cairo_);
  cairo_translate(cairo_, window.left + 0.5 * window.width, window.top + 0.5 * window.height);
  cairo_scale(cairo_, window.scale, -window.scale);
  cairo_rotate(cairo_, 0.5 * kPi - window.up_rad);
  cairo_translate(cairo_, -window.centre.x, -window.centre.y);
  cairo_set_line_cap(cairo_, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
}

Painter::~Painter() { cairo_restore(cairo_); }

void Painter::pen(const Colour& colour, double width_pixels) {
  set_colour(cairo_, colour);
  cairo_set_line_width(cairo_, width_pixels * pixel_);
}

void Painter::ring(Vec2 centre, double radius) {
  cairo_new_sub_path(cairo_);
  cairo_arc(cairo_, centre.x, centre.y, radius, 0, 2 * kPi);
  cairo_stroke(cairo_);
}

void Painter::walls(const std::vector<Scene::Line>& lines) {
  if (!shows(Layer::walls)) return;
  pen({0.15, 0.15, 0.15}, 1.6);
  for (const Scene::Line& line : lines) {
    cairo_move_to(cairo_, line.a.x, line.a.y);
    cairo_line_to(cairo_, line.b.x, line.b.y);
  }
  cairo_stroke(cairo_);
}

void Painter::places(const Scene& scene) {
  if (!shows(Layer::places)) return;
  pen(kPlaceGrey, 1.0);
  for (const Scene::Place& place : scene.places) {
    const auto says_so = [&](const Scene::Mark& mark) {
      return mark.label == place.name && norm(mark.position - place.position) < kSamePlace;
    };
    if (shows(Layer::marks) && std::ranges::any_of(scene.arrivals, says_so)) continue;
    ring(place.position, 2 * pixel_);
    if (take_room(place.position, place.name)) letters(place.position, {5, -4}, kPlacePixels, place.name);
  }
}

// Returns whether the name of a place lies on no other. If so, it counts as written.
bool Painter::take_room(Vec2 position, const std::string& text) {
  Vec2 from = position;
  cairo_user_to_device(cairo_, &from.x, &from.y);
  const Vec2 to{from.x + 0.65 * kPlacePixels * static_cast<double>(text.size()), from.y};
  for (std::size_t i = 0; i < labels_.size(); i += 2)
    if (from.x < labels_[i + 1].x && labels_[i].x < to.x && std::fabs(from.y - labels_[i].y) < kPlacePixels)
      return false;
  labels_.insert(labels_.end(), {from, to});
  return true;
}

void Painter::track(const std::vector<Vec2>& points, const Colour& colour) {
  if (!shows(Layer::track) || points.empty()) return;
  pen(colour, 2.0);
  for (const Vec2& p : points) cairo_line_to(cairo_, p.x, p.y);
  cairo_stroke(cairo_);
  ring(points.front(), 4 * pixel_);
}

void Painter::arrival(const Scene::Mark& arrival) { mark(arrival, kArrivalGreen); }

void Painter::contact(const Scene::Mark& contact) { mark(contact, kContactRed); }

void Painter::mark(const Scene::Mark& mark, const Colour& colour) {
  if (!shows(Layer::marks)) return;
  pen(colour, 3.0);
  ring(mark.position, 7 * pixel_);
  letters(mark.position, {10, -10}, 16, mark.label);
}

void Painter::letters(Vec2 beside, Vec2 offset_pixels, double height_pixels, const std::string& text) {
  cairo_save(cairo_);
  cairo_translate(cairo_, beside.x, beside.y);
  cairo_rotate(cairo_, window_.up_rad - 0.5 * kPi);  // letters stand upright
  cairo_scale(cairo_, pixel_, -pixel_);
  cairo_set_font_size(cairo_, height_pixels);
  cairo_move_to(cairo_, offset_pixels.x, offset_pixels.y);
  cairo_show_text(cairo_, text.c_str());
  cairo_new_path(cairo_);  // text leaves a current point behind
  cairo_restore(cairo_);
}

// Begins to draw in the frame of a robot, until cairo_restore().
void Painter::enter(const Pose2& pose) {
  cairo_save(cairo_);
  cairo_translate(cairo_, pose.x, pose.y);
  cairo_rotate(cairo_, pose.yaw);
}

void Painter::readings(const Scene::Moment& moment, double strength) {
  enter(moment.pose);
  if (shows(Layer::laser))
    for (const Scene::Scan& scan : moment.lasers) this->scan(scan, strength);
  if (shows(Layer::sonar))
    for (const Scene::Cone& cone : moment.sonar) this->cone(cone, strength);
  cairo_restore(cairo_);
}

void Painter::robot(const Scene::Robot& robot, const Scene::Moment& moment, const Colour& colour) {
  enter(moment.pose);
  if (shows(Layer::robot)) body(robot, colour);
  if (shows(Layer::motion)) motion(moment);
  cairo_restore(cairo_);
}

void Painter::name(const Scene::Robot& robot, const Scene::Moment& moment, const Colour& colour) {
  if (!shows(Layer::robot)) return;
  pen(colour, 1.0);
  const double beyond = robot.radius_m / pixel_ + 4;
  letters(moment.pose.position(), {0.7 * beyond, 0.7 * beyond + 10}, 14, robot.name);
}

// Makes a path round the robot's plan.
void Painter::outline(const Scene::Robot& robot) {
  if (robot.outline.empty()) {
    cairo_new_sub_path(cairo_);
    cairo_arc(cairo_, 0, 0, robot.radius_m, 0, 2 * kPi);
  }
  for (const Scene::Line& edge : robot.outline) cairo_line_to(cairo_, edge.a.x, edge.a.y);
  cairo_close_path(cairo_);
}

void Painter::body(const Scene::Robot& robot, const Colour& colour) {
  outline(robot);
  pen(colour.with_alpha(0.6), 1.0);
  cairo_fill(cairo_);
  outline(robot);
  pen(kInk, 2.0);
  cairo_move_to(cairo_, 0, 0);
  cairo_line_to(cairo_, robot.radius_m, 0);
  cairo_stroke(cairo_);
}

void Painter::cone(const Scene::Cone& cone, double strength) {
  cairo_move_to(cairo_, cone.X_RS.x, cone.X_RS.y);
  cairo_arc(cairo_, cone.X_RS.x, cone.X_RS.y, cone.range_m, cone.X_RS.yaw - cone.half_lobe_rad,
            cone.X_RS.yaw + cone.half_lobe_rad);
  cairo_close_path(cairo_);
  pen({1.0, 0.85, 0.0, strength * (cone.echo ? 0.35 : 0.07)}, 1.0);
  cairo_fill(cairo_);
  if (!cone.echo) return;
  pen(kSonarYellow.with_alpha(strength), 2.0);
  cairo_arc(cairo_, cone.X_RS.x, cone.X_RS.y, cone.range_m, cone.X_RS.yaw - cone.half_lobe_rad,
            cone.X_RS.yaw + cone.half_lobe_rad);
  cairo_stroke(cairo_);
}

void Painter::scan(const Scene::Scan& scan, double strength) {
  cairo_move_to(cairo_, scan.at.x, scan.at.y);
  for (const Vec2& end : scan.ends) cairo_line_to(cairo_, end.x, end.y);
  cairo_close_path(cairo_);
  pen({0.1, 0.4, 1.0, 0.12 * strength}, 1.0);
  cairo_fill(cairo_);
  pen(kLaserBlue.with_alpha(strength), 3.0);
  for (const Vec2& end : scan.ends) {
    cairo_move_to(cairo_, end.x, end.y);
    cairo_close_path(cairo_);
  }
  cairo_stroke(cairo_);
}

void Painter::motion(const Scene::Moment& moment) {
  pen(kMotionRed, 3.0);
  if (std::abs(moment.speed) >= kLeastMotion) {
    cairo_move_to(cairo_, 0, 0);
    cairo_line_to(cairo_, moment.speed, 0);
    cairo_stroke(cairo_);
    head({moment.speed, 0}, moment.speed > 0 ? 0.0 : kPi);
  }
  if (std::abs(moment.turn_rate) < kLeastMotion) return;
  const double turn = std::clamp(moment.turn_rate, -kLongestTurn, kLongestTurn);
  (turn > 0 ? cairo_arc : cairo_arc_negative)(cairo_, 0, 0, kTurnRadius, 0, turn);
  cairo_stroke(cairo_);
  head({kTurnRadius * std::cos(turn), kTurnRadius * std::sin(turn)}, turn + std::copysign(0.5 * kPi, turn));
}

void Painter::head(Vec2 tip, double direction_rad) {
  const double length = 9 * pixel_;
  for (const double side : {0.85 * kPi, -0.85 * kPi}) {
    cairo_move_to(cairo_, tip.x, tip.y);
    cairo_rel_line_to(cairo_, length * std::cos(direction_rad + side),
                      length * std::sin(direction_rad + side));
  }
  cairo_stroke(cairo_);
}

void Painter::frame() {
  cairo_save(cairo_);
  cairo_identity_matrix(cairo_);
  cairo_set_source_rgb(cairo_, 0.7, 0.7, 0.7);
  cairo_set_line_width(cairo_, 2.0);
  cairo_rectangle(cairo_, window_.left, window_.top, window_.width, window_.height);
  cairo_stroke(cairo_);
  cairo_restore(cairo_);
}

}  // namespace orca::host
