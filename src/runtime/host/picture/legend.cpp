// SPDX-License-Identifier: LGPL-3.0-or-later
#include "legend.hpp"

#include <algorithm>
#include <cmath>

namespace orca::host {
namespace {

constexpr double kRowPixels = 24.0;
constexpr double kBarSpacePixels = 220.0;  // at the right, for the scale
constexpr double kLongestBarPixels = 180.0;
constexpr double kMarginPixels = 12.0;
constexpr double kLetterPixels = 14.0;
constexpr double kMostPixelsPerLetter = 10.0;
constexpr double kSwatchPixels = 18.0;  // with the gap behind it
constexpr double kGapPixels = 16.0;
constexpr std::size_t kLongestName = 16;  // [letters]

// Returns the longest of 1, 2 and 5 times a power of ten that is not longer than `limit`.
double round_length(double limit) {
  const double power = std::pow(10.0, std::floor(std::log10(limit)));
  for (const double step : {5.0, 2.0})
    if (step * power <= limit) return step * power;
  return power;
}

std::string length_text(double metres) {
  if (metres >= 1.0) return std::to_string(std::lround(metres)) + " m";
  return std::to_string(std::lround(100.0 * metres)) + " cm";
}

// Returns the name, cut between two characters of UTF-8 if it is long.
std::string shortened(const std::string& name) {
  if (name.size() <= kLongestName) return name;
  std::size_t end = kLongestName - 2;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;
  return name.substr(0, end) + "..";
}

template <class Has>
bool any_moment(const Scene& scene, Has has) {
  return std::ranges::any_of(
      scene.robots, [&](const Scene::Robot& robot) { return std::ranges::any_of(robot.moments, has); });
}

}  // namespace

Legend::Legend(const Scene& scene, const std::set<Layer>& hidden, double width, double scale)
    : width_(width), scale_(scale), next_left_(kMarginPixels) {
  add_robots(scene);
  add_layers(scene, hidden);
}

// Appends an entry to the row, or to a new row if there is no room.
void Legend::add(const std::string& text, const Colour& colour) {
  const double width = kSwatchPixels + kMostPixelsPerLetter * static_cast<double>(text.size());
  if (next_left_ > kMarginPixels && next_left_ + width > width_ - kBarSpacePixels) {
    next_left_ = kMarginPixels;
    next_top_ += kRowPixels;
  }
  entries_.push_back({text, colour, next_left_, next_top_});
  next_left_ += width + kGapPixels;
}

void Legend::add_robots(const Scene& scene) {
  for (std::size_t i = 0; i < scene.robots.size(); ++i) add(shortened(scene.robots[i].name), robot_colour(i));
}

void Legend::add_layers(const Scene& scene, const std::set<Layer>& hidden) {
  const auto add_if = [&](Layer layer, bool there, const char* text, const Colour& colour) {
    if (there && !hidden.contains(layer)) add(text, colour);
  };
  add_if(Layer::sonar, any_moment(scene, [](const auto& m) { return !m.sonar.empty(); }), "sonar",
         kSonarYellow);
  add_if(Layer::laser, any_moment(scene, [](const auto& m) { return !m.lasers.empty(); }), "laser",
         kLaserBlue);
  add_if(Layer::motion, any_moment(scene, [](const auto& m) { return m.speed != 0.0 || m.turn_rate != 0.0; }),
         "speed, turn", kMotionRed);
  add_if(Layer::marks, !scene.arrivals.empty(), "arrival", kArrivalGreen);
  add_if(Layer::marks, !scene.contacts.empty(), "contact", kContactRed);
}

double Legend::height() const { return next_top_ + kRowPixels + kMarginPixels; }

void Legend::draw(cairo_t* cairo, double top) const {
  cairo_set_font_size(cairo, kLetterPixels);
  for (const Entry& entry : entries_) draw_entry(cairo, entry, top + entry.top);
  draw_bar(cairo, top);
}

void Legend::draw_entry(cairo_t* cairo, const Entry& entry, double top) {
  set_colour(cairo, entry.colour);
  cairo_rectangle(cairo, entry.left, top + 6, 12, 12);
  cairo_fill(cairo);
  set_colour(cairo, kInk);
  cairo_move_to(cairo, entry.left + kSwatchPixels, top + 17);
  cairo_show_text(cairo, entry.text.c_str());
  cairo_new_path(cairo);
}

void Legend::draw_bar(cairo_t* cairo, double top) const {
  const double metres = round_length(std::min(kLongestBarPixels, 0.4 * width_) / scale_);
  const std::string text = length_text(metres);
  cairo_text_extents_t size;
  cairo_text_extents(cairo, text.c_str(), &size);
  const double right = width_ - kMarginPixels - size.x_advance - 6;
  const double left = right - metres * scale_;
  const double middle = top + 12;
  set_colour(cairo, kInk);
  cairo_set_line_width(cairo, 2.0);
  for (const double end : {left, right}) {
    cairo_move_to(cairo, end, middle - 5);
    cairo_line_to(cairo, end, middle + 5);
  }
  cairo_move_to(cairo, left, middle);
  cairo_line_to(cairo, right, middle);
  cairo_stroke(cairo);
  cairo_move_to(cairo, right + 6, middle + 5);
  cairo_show_text(cairo, text.c_str());
  cairo_new_path(cairo);
}

}  // namespace orca::host
