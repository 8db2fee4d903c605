// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/bitmap.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>

#include "orca/xml/number.hpp"

namespace orca::sim {
namespace {

constexpr std::uint8_t kOccupiedBelow = 128;
constexpr std::uint8_t kWhiteFrom = 240;
constexpr std::uint8_t kWhite = 255;
constexpr double kUsualLight = 0.05;  // light grey pixels per solid one: the specks of a scanned plan

// The picture as a plan: column to the right, row UP; everything outside is free.
class Plan {
 public:
  explicit Plan(const GreyImage& image) : image_(image) {}
  [[nodiscard]] std::int64_t columns() const { return static_cast<std::int64_t>(image_.width); }
  [[nodiscard]] std::int64_t rows() const { return static_cast<std::int64_t>(image_.height); }
  [[nodiscard]] bool occupied(std::int64_t column, std::int64_t row) const {
    return grey(column, row) < kOccupiedBelow;
  }
  [[nodiscard]] bool light_grey(std::int64_t column, std::int64_t row) const {
    return !occupied(column, row) && grey(column, row) < kWhiteFrom;
  }
  [[nodiscard]] bool touches_solid(std::int64_t column, std::int64_t row) const {
    for (std::int64_t r = row - 1; r <= row + 1; ++r)
      for (std::int64_t c = column - 1; c <= column + 1; ++c)
        if (occupied(c, r)) return true;
    return false;
  }

 private:
  [[nodiscard]] std::uint8_t grey(std::int64_t column, std::int64_t row) const {
    if (column < 0 || row < 0 || column >= columns() || row >= rows()) return kWhite;
    const std::int64_t from_top = rows() - 1 - row;
    return image_.grey[static_cast<std::size_t>(from_top * columns() + column)];
  }

  const GreyImage& image_;
};

// The boundary between two neighbouring cells: none, or solid on the one or the other side.
enum class Border { none, solid_after, solid_before };

Border border(bool before, bool after) {
  if (before == after) return Border::none;
  return after ? Border::solid_after : Border::solid_before;
}

// Merges equal neighbours along one line of the lattice; `at(i)` is the border at place i of the line.
template <class At, class Emit>
void merge_runs(std::int64_t length, const At& at, const Emit& emit) {
  std::int64_t start = 0;
  Border run = Border::none;
  for (std::int64_t i = 0; i <= length; ++i) {
    const Border here = i < length ? at(i) : Border::none;
    if (here == run) continue;
    if (run != Border::none) emit(start, i, run);
    start = i;
    run = here;
  }
}

constexpr std::size_t kMostEdges = 2'000'000;

void add_edge(Outline& out, Vec2 from, Vec2 to, bool forward) {
  if (out.edges.size() <= kMostEdges) out.edges.push_back(forward ? Segment{from, to} : Segment{to, from});
}

void horizontal_edges(const Plan& plan, double pixel, Outline& out) {
  for (std::int64_t line = 0; line <= plan.rows(); ++line) {
    const double y = static_cast<double>(line) * pixel;
    merge_runs(
        plan.columns(),
        [&](std::int64_t c) { return border(plan.occupied(c, line - 1), plan.occupied(c, line)); },
        [&](std::int64_t from, std::int64_t to, Border kind) {
          add_edge(out, {static_cast<double>(from) * pixel, y}, {static_cast<double>(to) * pixel, y},
                   kind == Border::solid_after);
        });
  }
}

void vertical_edges(const Plan& plan, double pixel, Outline& out) {
  for (std::int64_t line = 0; line <= plan.columns(); ++line) {
    const double x = static_cast<double>(line) * pixel;
    merge_runs(
        plan.rows(),
        [&](std::int64_t r) { return border(plan.occupied(line - 1, r), plan.occupied(line, r)); },
        [&](std::int64_t from, std::int64_t to, Border kind) {
          add_edge(out, {x, static_cast<double>(from) * pixel}, {x, static_cast<double>(to) * pixel},
                   kind == Border::solid_before);
        });
  }
}

constexpr double kLargest = 1e5;  // [m] of a world, in either direction

}  // namespace

Result<double> pixel_size(const BitmapScale& scale, const GreyImage& image) {
  if (scale.map_width.has_value() == scale.resolution.has_value())
    return fail(Code::invalid_argument,
                scale.map_width ? "both map_width and map_resolution are given; give one of them"
                                : "a bitmap has no size of its own: give map_width, the width of the whole "
                                  "picture, e.g. \"140 m\", or map_resolution, the side of a pixel");
  const double value = scale.map_width ? *scale.map_width : *scale.resolution;
  const double pixel = scale.map_width ? value / static_cast<double>(image.width) : value;
  if (!(value > 0.0 && pixel * static_cast<double>(std::max(image.width, image.height)) <= kLargest))
    return fail(Code::invalid_argument,
                std::string(scale.map_width ? "the width is " : "the resolution is ") +
                    xml::number_text(value) +
                    " m; it must be more than 0 m, and the map at most 100 km wide and high");
  return pixel;
}

Result<Outline> outline_of(const GreyImage& image, double pixel) {
  const Plan plan(image);
  Outline outline;
  horizontal_edges(plan, pixel, outline);
  if (outline.edges.size() <= kMostEdges) vertical_edges(plan, pixel, outline);
  if (outline.edges.size() <= kMostEdges) return outline;
  return fail(Code::invalid_argument,
              "the picture has more than 2000000 edges between dark and light, the most that a map may have; "
              "smooth it, or make it black and white without dithering");
}

Result<WorldModel> bitmap_world(const GreyImage& image, double pixel, const std::string& name,
                                double height) {
  Result<Outline> outline = outline_of(image, pixel);
  if (!outline) return outline.error();
  if (outline->edges.empty())
    return fail(
        Code::invalid_argument,
        "no pixel of the picture is darker than grey 128, so nothing is solid; is it the right picture?");
  WorldModel world;
  world.name = name;
  world.obstacles.push_back({"map", std::move(*outline), height});
  return world;
}

// Grey beside something solid is the soft edge of a line.
std::optional<std::string> doubt_about(const GreyImage& image) {
  const Plan plan(image);
  std::size_t light = 0, solid = 0;
  for (std::int64_t row = 0; row < plan.rows(); ++row)
    for (std::int64_t column = 0; column < plan.columns(); ++column) {
      solid += plan.occupied(column, row) ? 1 : 0;
      light += plan.light_grey(column, row) && !plan.touches_solid(column, row) ? 1 : 0;
    }
  if (solid == 0) return std::nullopt;  // such a picture is refused
  if (static_cast<double>(light) <= kUsualLight * static_cast<double>(solid)) return std::nullopt;
  const double share = 100.0 * static_cast<double>(light) / static_cast<double>(image.grey.size());
  std::array<char, 16> percent{};
  std::snprintf(percent.data(), percent.size(), "%.2g", share);
  return std::string(percent.data()) +
         " % of the pixels are light grey (128 to 239), neither solid nor white, and count as free; if walls "
         "are among "
         "them, draw these darker than 128";
}

Result<WorldModel> read_bitmap_world(const std::string& path, const BitmapScale& scale, double height,
                                     std::optional<std::string>* doubt) {
  const Result<GreyImage> image = image::read_image(path);
  if (!image) return image.error();
  if (doubt != nullptr) *doubt = doubt_about(*image);
  const Result<double> pixel = pixel_size(scale, *image);
  if (!pixel) return fail(pixel.error().code, pixel.error().message, path);
  Result<WorldModel> world =
      bitmap_world(*image, *pixel, std::filesystem::path(path).stem().string(), height);
  if (!world) return fail(world.error().code, world.error().message, path);
  return world;
}

}  // namespace orca::sim
