// SPDX-License-Identifier: LGPL-3.0-or-later
#include "plots.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
namespace orca::batch {
namespace {

// Colours that people with any colour vision distinguish (M. Okabe and K. Ito, "Color universal design", 2008).
constexpr std::array kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};
constexpr double kWidth = 640.0, kHeight = 320.0, kLeft = 52.0, kBottom = 40.0, kTop = 12.0, kRight = 150.0;
constexpr double kMapWidth = 420.0, kMostMapHeight = 520.0, kMapMargin = 0.3;

const char* colour(std::size_t number) { return kColours[number % kColours.size()]; }

std::string number(double value, const char* format = "%.1f") {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// Returns 1, 2 or 5 times a power of ten, so that some five steps make up the range.
double step_of(double range) {
  const double raw = range / 5.0;
  double power = 1.0;
  while (10.0 * power <= raw) power *= 10.0;
  while (power > raw) power /= 10.0;
  for (const double factor : {1.0, 2.0, 5.0})
    if (raw <= factor * power) return factor * power;
  return 10.0 * power;
}

// The frame of a plot from values to pixels.
struct Axes {
  double low, high;
  [[nodiscard]] double x(double value) const {
    return kLeft + (value - low) / (high - low) * (kWidth - kLeft - kRight);
  }
  [[nodiscard]] static double y(double share) {
    return kHeight - kBottom - share * (kHeight - kBottom - kTop);
  }
};

Axes axes_of(const std::vector<Series>& all) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Series& series : all) {
    for (const double value : series.values) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  const double margin = high > low ? 0.05 * (high - low) : std::max(0.05 * std::fabs(high), 0.05);
  return {low - margin, high + margin};
}

void draw_ticks(const Axes& axes, const std::string& title, Drawing& drawing) {
  for (int i = 0; i <= 4; ++i) {
    const double share = 0.25 * i;
    const double y = Axes::y(share);
    drawing.add(Stroke{{kLeft, y}, {kWidth - kRight, y}, "#ddd"});
    drawing.add(Words{{kLeft - 6.0, y + 4.0}, number(100.0 * share, "%.0f %%"), "end"});
  }
  const double step = step_of(axes.high - axes.low);
  for (double value = std::ceil(axes.low / step) * step; value <= axes.high; value += step) {
    const Vec2 at{axes.x(value), Axes::y(0.0)};
    drawing.add(Stroke{at, {at.x, at.y + 4.0}, "#888"});
    drawing.add(
        Words{{at.x, at.y + 17.0}, number(std::fabs(value) < 1e-9 * step ? 0.0 : value, "%.4g"), "middle"});
  }
  drawing.add(Words{{0.5 * (kLeft + kWidth - kRight), kHeight - 6.0}, title, "middle"});
}

// A step up at each value.
std::vector<Vec2> steps_of(const Series& series, const Axes& axes) {
  std::vector<double> values = series.values;
  std::ranges::sort(values);
  std::vector<Vec2> points{{axes.x(axes.low), Axes::y(0.0)}};
  const auto runs = static_cast<double>(std::max(series.runs, values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    points.push_back({axes.x(values[i]), Axes::y(static_cast<double>(i) / runs)});
    points.push_back({axes.x(values[i]), Axes::y(static_cast<double>(i + 1) / runs)});
  }
  points.push_back({axes.x(axes.high), Axes::y(static_cast<double>(values.size()) / runs)});
  return points;
}

struct Area {
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  void add(Vec2 place) {
    low = {std::min(low.x, place.x - kMapMargin), std::min(low.y, place.y - kMapMargin)};
    high = {std::max(high.x, place.x + kMapMargin), std::max(high.y, place.y + kMapMargin)};
  }
};

// From metres to pixels; y points up in the world, and down in a drawing.
struct MapFrame {
  Area area;
  double scale;
  [[nodiscard]] Vec2 operator()(Vec2 place) const {
    return {scale * (place.x - area.low.x), scale * (area.high.y - place.y)};
  }
};

MapFrame frame_of(const Map& map) {
  Area area;
  for (const Places& wall : map.walls)
    for (const Vec2& place : wall) area.add(place);
  for (const Track& track : map.tracks)
    for (const Vec2& place : track.places) area.add(place);
  const Vec2 size = area.high - area.low;
  return {area, std::min(kMapWidth / size.x, kMostMapHeight / size.y)};
}

void draw(const Track& track, const MapFrame& frame, Drawing& drawing) {
  if (track.places.empty()) return;
  Places points;
  for (const Vec2& place : track.places) points.push_back(frame(place));
  const Vec2 end = points.back();
  drawing.add(Polyline{std::move(points), colour(track.variant), 1.5});
  if (track.ends_badly) drawing.add(Circle{end, colour(track.variant)});
}

void draw_cross(Vec2 at, Drawing& drawing) {
  constexpr double kHalf = 5.0;  // [pixels]
  for (const double down : {kHalf, -kHalf})
    drawing.add(Stroke{{at.x - kHalf, at.y - down}, {at.x + kHalf, at.y + down}, "#d00000"});
}

}  // namespace

Drawing distribution_plot(const std::string& axis, const std::vector<Series>& all) {
  Drawing drawing{{kWidth, kHeight}};
  const Axes axes = axes_of(all);
  draw_ticks(axes, axis, drawing);
  for (std::size_t i = 0; i < all.size(); ++i) {
    drawing.add(Polyline{steps_of(all[i], axes), colour(i), 2.0});
    const double y = kTop + 14.0 + 18.0 * static_cast<double>(i);
    drawing.add(Words{{kWidth - kRight + 10.0, y}, all[i].name, "start", colour(i)});
  }
  return drawing;
}

Drawing map_plot(const Map& map) {
  const MapFrame frame = frame_of(map);
  const Vec2 size = frame.area.high - frame.area.low;
  Drawing drawing{{frame.scale * size.x, frame.scale * size.y}};
  Walls walls;
  for (const Places& wall : map.walls) {
    walls.lines.emplace_back();
    for (const Vec2& place : wall) walls.lines.back().push_back(frame(place));
  }
  drawing.add(std::move(walls));
  for (const Track& track : map.tracks) draw(track, frame, drawing);
  for (const Vec2& contact : map.contacts) draw_cross(frame(contact), drawing);
  return drawing;
}

Drawing legend_plot(const std::vector<std::string>& variants) {
  Drawing drawing{{0.0, 18.0}};
  double x = 0.0;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    drawing.add(Bar{{x, 4.0}, {14.0, 4.0}, colour(i)});
    drawing.add(Words{{x + 20.0, 12.0}, variants[i], "start", colour(i)});
    x += 40.0 + 8.0 * static_cast<double>(variants[i].size());
  }
  drawing.size.x = std::max(x, 1.0);
  return drawing;
}

std::vector<Places> read_lines(const std::string& text) {
  std::vector<Places> lines(1);
  const char* at = text.c_str();
  for (Vec2 place; *at != '\0';) {
    int taken = 0;
    if (std::sscanf(at, "%lf %lf%n", &place.x, &place.y, &taken) != 2) break;
    lines.back().push_back(place);
    at += taken;
    if (*at == ';') lines.emplace_back();
    if (*at != '\0') ++at;
  }
  std::erase_if(lines, [](const Places& one) { return one.empty(); });
  return lines;
}

}  // namespace orca::batch
