// SPDX-License-Identifier: LGPL-3.0-or-later
#include "colour_finder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "orca/base/portable_math.hpp"

namespace orca::colour {
namespace {

constexpr std::size_t kMostColumns = 320;  // Looked at, however wide the picture is.
constexpr double kSameCosine = 0.985;      // For the angle between two shades of a colour: 10 degrees.
constexpr int kDarkest = 60;               // Sum of the parts below which a pixel has no colour.
constexpr std::size_t kFewest = 3;         // Rows of it that a column must have.
constexpr double kFar = 1.25;              // Its foot counts if all else says that it is so much farther.
constexpr double kUnknown = std::numeric_limits<double>::infinity();  // [m]

// Whether pixels have a colour.
class Match {
 public:
  Match(const Picture& picture, Colour colour)
      : picture_(picture),
        red_(colour.red),
        green_(colour.green),
        blue_(colour.blue),
        least_(kSameCosine * kSameCosine * (red_ * red_ + green_ * green_ + blue_ * blue_)) {}

  [[nodiscard]] bool at(std::size_t column, std::size_t row) const {
    const std::uint8_t* const p = picture_.bytes.data() + row * picture_.step + 3 * column;
    const int r = p[0];
    const int g = p[1];
    const int b = p[2];
    if (r + g + b < kDarkest) return false;
    const auto along = static_cast<double>(r * red_ + g * green_ + b * blue_);
    return along * along >= least_ * static_cast<double>(r * r + g * g + b * b);
  }

 private:
  const Picture& picture_;
  const int red_, green_, blue_;
  const double least_;
};

struct Group {
  std::size_t first = 0, last = 0;      // Columns.
  std::size_t highest = 0, lowest = 0;  // Rows.
  std::size_t pixels = 0;
};

struct Seen {
  std::size_t pixels = 0;
  std::size_t highest = 0, lowest = 0;  // Rows.
};

Seen look(const Match& match, std::size_t column, std::size_t height, std::size_t stride) {
  Seen seen;
  for (std::size_t row = stride / 2; row < height; row += stride)
    if (match.at(column, row)) seen = {seen.pixels + 1, seen.pixels == 0 ? row : seen.highest, row};
  return seen;
}

// Returns the group of adjacent columns with most of the colour.
Group largest_group(const Picture& picture, const Match& match, std::size_t stride) {
  Group best;
  Group now;
  for (std::size_t column = stride / 2; column < picture.width; column += stride) {
    const Seen seen = look(match, column, picture.height, stride);
    if (seen.pixels < kFewest) {
      now = {};
      continue;
    }
    if (now.pixels == 0) now = {column, column, seen.highest, seen.lowest, 0};
    now.last = column;
    now.highest = std::min(now.highest, seen.highest);
    now.lowest = std::max(now.lowest, seen.lowest);
    now.pixels += seen.pixels;
    if (now.pixels > best.pixels) best = now;
  }
  return best;
}

// Moves the outer columns out to where the colour really ends.
void widen(Group& group, const Picture& picture, const Match& match, std::size_t stride) {
  const auto has = [&](std::size_t column) {
    return look(match, column, picture.height, stride).pixels >= kFewest;
  };
  while (group.first > 0 && has(group.first - 1)) --group.first;
  while (group.last + 1 < picture.width && has(group.last + 1)) ++group.last;
}

// The distance from what the picture shows of a group; see find_colour().
Sighting place(const Picture& picture, const Wanted& wanted, const Group& group, std::size_t stride) {
  const double middle = 0.5 * static_cast<double>(picture.width);
  const auto bearing_at = [&](std::size_t edge) {
    return portable::atan2(middle - static_cast<double>(edge), picture.focal_length);
  };
  const double left = bearing_at(group.first);
  const double right = bearing_at(group.last + 1);
  const double bearing = 0.5 * (left + right);
  // Returns how far its middle is if the side towards the camera is `off` [m] above or below the camera in that row; infinite if the row shows nothing of that.
  const auto by_row = [&](double off, double rows) {
    if (off <= 0.0 || rows <= 0.0) return kUnknown;
    return picture.focal_length * off / rows / portable::cos(bearing) + wanted.radius;
  };
  const double horizon = 0.5 * static_cast<double>(picture.height);
  const bool shows_head = group.highest > stride;
  const bool shows_foot = group.lowest + stride < picture.height;
  const double head =
      shows_head ? by_row(wanted.height - wanted.camera_height, horizon - static_cast<double>(group.highest))
                 : kUnknown;
  const double foot =
      shows_foot ? by_row(wanted.camera_height, static_cast<double>(group.lowest + 1) - horizon) : kUnknown;
  const bool is_cut = group.first == 0 || group.last + 1 == picture.width;
  const double width = wanted.radius / portable::sin(0.5 * (left - right));
  const double best = std::min(is_cut ? kUnknown : width, head);
  if (best > kFar * foot) return {bearing, foot};
  return {bearing, std::isfinite(best) ? best : width};
}

}  // namespace

std::optional<Sighting> find_colour(const Picture& picture, const Wanted& wanted) {
  const std::size_t stride = std::max(std::size_t{1}, picture.width / kMostColumns);
  const Match match(picture, wanted.colour);
  Group group = largest_group(picture, match, stride);
  if (group.pixels == 0) return std::nullopt;
  widen(group, picture, match, stride);
  return place(picture, wanted, group, stride);
}

}  // namespace orca::colour
